// A State Branch as plain tables of text, which compile quickly however many states there are. Each
// table ends with a row without a name.
#pragma once

#include "elements.hpp"

namespace dsfo {

struct EdgeRow {
    int state;
    const char* operation;
    int target;
};

struct FailureRow {
    int state;
    const char* why;
};

// `names` has each state as its name and the value of each of its facts.
std::vector<State> states_of(
    const char* const* names, std::size_t facts, const EdgeRow* edges, const FailureRow* failures);

// One text of all pieces, the last of which is null.
std::string text_of(const char* const* pieces);

}  // namespace dsfo
