// The facts for which people must be asked: needed now, unknown, and theirs to tell.
#pragma once

#include "people.hpp"

namespace dsfo {

// For the facts that make state checks unknown. A check that is false stays false whatever people
// tell.
std::vector<Question> needed_in(const LiveRun& run, const std::vector<Check>& checks);

// For the unknown facts that the guards of a step need.
std::vector<Question> needed_of(const LiveRun& run, const JointStep& step);

// For all unknown facts that people may tell.
std::vector<Question> needed_everywhere(const LiveRun& run);

// Whether all these terms are unknown, and people may tell what they depend on.
bool all_theirs(const LiveRun& run, const std::vector<Term>& terms);

}  // namespace dsfo
