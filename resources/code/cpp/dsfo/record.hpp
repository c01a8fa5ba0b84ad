// The inspection record with which the code was generated: its digest is compiled in, and demanded at
// start.
#pragma once

#include "elements.hpp"

namespace dsfo {

// Why a run may not start; empty if it may. `record` and `file` are the paths of the record and of the
// blueprint, empty if they were not named.
std::string start_refused(
    const Blueprint& blueprint, const std::string& record, const std::string& file);

}  // namespace dsfo
