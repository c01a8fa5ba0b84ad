#include "tables.hpp"

namespace dsfo {

std::vector<State> states_of(
    const char* const* names, std::size_t facts, const EdgeRow* edges, const FailureRow* failures) {
    std::vector<State> found;
    for (; *names != nullptr; names += 1 + facts) {
        State one;
        one.name = *names;
        one.facts.assign(names + 1, names + 1 + facts);
        found.push_back(one);
    }
    for (; edges->operation != nullptr; ++edges) {
        State& own = found[static_cast<std::size_t>(edges->state)];
        own.operations.emplace_back(edges->operation, edges->target);
    }
    for (; failures->why != nullptr; ++failures) {
        found[static_cast<std::size_t>(failures->state)].fails = failures->why;
    }
    return found;
}

std::string text_of(const char* const* pieces) {
    std::string found;
    for (; *pieces != nullptr; ++pieces) {
        found += *pieces;
    }
    return found;
}

}  // namespace dsfo
