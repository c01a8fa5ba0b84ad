// The faults of the table world, for trials and exercises. All but `set` befall the next operation,
// or the one whose address is given.
#pragma once

#include "json_reader.hpp"
#include "world.hpp"

namespace dsfo {

// Why there is no such fault, or why its parameters do not fit; empty if all is well. `given` has
// the name of the fault and its parameters.
std::string fault_refused(const std::map<std::string, Json>& given);

// Causes a fault. Why it was not caused, or empty.
std::string inject_fault(
    World& world, const Hierarchy& hierarchy, const std::map<std::string, Json>& given);

}  // namespace dsfo
