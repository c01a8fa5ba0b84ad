// Finds the elements that people name. The SB may be left out where there is one root.
#pragma once

#include "hierarchy.hpp"

namespace dsfo {

// The states that people name, at most one of each SB. `wrong` says what makes no sense.
std::map<int, int> states_at(
    const Hierarchy& hierarchy, const std::vector<std::string>& written, const std::string& what,
    std::string& wrong);

// The addresses of operations. A state means all that lead out of it, the name of an operation all
// edges of this name.
std::vector<std::string> operations_at(
    const Hierarchy& hierarchy, const std::vector<std::string>& written, std::string& wrong);

}  // namespace dsfo
