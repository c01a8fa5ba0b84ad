#include "addresses.hpp"

namespace dsfo {

namespace {

struct Found {
    int branch;
    int state;
    std::string operation;  // its address, empty for a state
};

// Whether a text names an element: by its address, or with the `/` of names as they are.
bool names(
    const Hierarchy& hierarchy, int branch, const std::string& text,
    const std::vector<std::string>& rest, bool spelt) {
    std::vector<std::string> whole{hierarchy.of(branch).name};
    whole.insert(whole.end(), rest.begin(), rest.end());
    const bool alone = hierarchy.roots.size() == 1 && hierarchy.roots.front() == branch;
    const auto shown = [spelt](const std::vector<std::string>& one) {
        return spelt ? joined(one, "/") : address(one);
    };
    return text == shown(whole) || (alone && text == shown(rest));
}

std::vector<Found> found_in(const Hierarchy& hierarchy, const std::string& text, bool spelt) {
    std::vector<Found> found;
    const std::vector<Branch>& branches = hierarchy.blueprint.branches;
    for (std::size_t at = 0; at < branches.size(); ++at) {
        const int branch = static_cast<int>(at);
        for (std::size_t state = 0; state < branches[at].states.size(); ++state) {
            const State& own = branches[at].states[state];
            if (names(hierarchy, branch, text, {own.name}, spelt)) {
                found.push_back(Found{branch, static_cast<int>(state), ""});
            }
            for (const auto& [name, target] : own.operations) {
                if (names(hierarchy, branch, text, {own.name, name}, spelt)) {
                    const std::string edge = address({branches[at].name, own.name, name});
                    found.push_back(Found{branch, static_cast<int>(state), edge});
                }
            }
        }
    }
    return found;
}

std::vector<Found> found_at(const Hierarchy& hierarchy, const std::string& text) {
    std::vector<Found> found = found_in(hierarchy, text, false);
    if (found.empty()) {
        found = found_in(hierarchy, text, true);
    }
    // SB/State comes before State/Operation of the only root
    if (found.size() > 1 && found.front().operation.empty() != found.back().operation.empty()) {
        found.erase(found.begin() + 1, found.end());
    }
    return found;
}

}  // namespace

std::map<int, int> states_at(
    const Hierarchy& hierarchy, const std::vector<std::string>& written, const std::string& what,
    std::string& wrong) {
    std::map<int, int> states;
    for (const std::string& text : written) {
        const std::vector<Found> found = found_at(hierarchy, text);
        if (found.size() != 1 || !found.front().operation.empty()) {
            wrong = text + " is no state. Write SB/State.";
        } else if (!states.emplace(found.front().branch, found.front().state).second) {
            const std::string& name = hierarchy.of(found.front().branch).name;
            wrong = name + " has two " + what + "s. Give one " + what + " for each SB.";
        }
    }
    return states;
}

std::vector<std::string> operations_at(
    const Hierarchy& hierarchy, const std::vector<std::string>& written, std::string& wrong) {
    std::vector<std::string> edges;
    for (const std::string& text : written) {
        const std::size_t before = edges.size();
        const std::vector<Found> found = found_at(hierarchy, text);
        bool state = false;
        if (found.size() == 1) {
            const Branch& branch = hierarchy.of(found.front().branch);
            const State& own = branch.states[static_cast<std::size_t>(found.front().state)];
            state = found.front().operation.empty();
            for (const auto& [name, target] : own.operations) {
                const std::string edge = address({branch.name, own.name, name});
                if (state || edge == found.front().operation) {
                    edges.push_back(edge);
                }
            }
        }
        const std::vector<std::string> asked = parts(text);
        for (const Branch& branch : hierarchy.blueprint.branches) {
            for (const State& own : branch.states) {
                for (const auto& [name, target] : own.operations) {
                    const bool named = asked == std::vector<std::string>{name} ||
                                       asked == std::vector<std::string>{branch.name, name};
                    if (found.empty() && named) {
                        edges.push_back(address({branch.name, own.name, name}));
                    }
                }
            }
        }
        if (edges.size() == before && !state) {
            wrong = text + " is no operation. Write SB/State/Operation.";
        }
    }
    return edges;
}

}  // namespace dsfo
