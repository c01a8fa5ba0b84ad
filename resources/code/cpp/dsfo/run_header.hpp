// The header of the log of a run: what was asked for, and where it ran.
#pragma once

#include "dispatcher.hpp"
#include "script.hpp"

namespace dsfo {

std::string header_of(
    const Hierarchy& hierarchy, const World& world, const Terms& terms,
    const Script& script = {});

}  // namespace dsfo
