// The command line: `run` carries the blueprint out. Exit status 0: every goal was reached; 1: it was
// not; 2: wrong usage.
#pragma once

#include "world.hpp"

namespace dsfo {

int command_line(
    const Hierarchy& hierarchy, World& world, const std::vector<std::string>& words);

}  // namespace dsfo
