#include "hierarchy.hpp"

#include <algorithm>
#include <set>

namespace dsfo {

namespace {

std::size_t index(int number) { return static_cast<std::size_t>(number); }

}  // namespace

Hierarchy::Hierarchy(const Blueprint& whole) : blueprint(whole) {
    const std::size_t count = whole.branches.size();
    subs.resize(count);
    bases.resize(count);
    place.resize(count);
    for (std::size_t at = 0; at < count; ++at) {
        const std::vector<Flag>& flags = whole.branches[at].flags;
        for (std::size_t digit = 0; digit < flags.size(); ++digit) {
            if (!flags[digit].sub.empty()) {
                const int sub = whole.number_of(flags[digit].sub);
                subs[at].emplace_back(static_cast<int>(digit), sub);
                bases[index(sub)].emplace_back(static_cast<int>(at), static_cast<int>(digit));
            }
        }
    }
    std::vector<std::size_t> waiting;
    std::set<int> free;
    for (std::size_t at = 0; at < count; ++at) {
        waiting.push_back(bases[at].size());
        if (bases[at].empty()) {
            roots.push_back(static_cast<int>(at));
            free.insert(static_cast<int>(at));
        }
    }
    while (!free.empty()) {
        const int next = *free.begin();
        free.erase(free.begin());
        place[index(next)] = static_cast<int>(order.size());
        order.push_back(next);
        for (const auto& [digit, sub] : subs[index(next)]) {
            (void)digit;
            if (--waiting[index(sub)] == 0) {
                free.insert(sub);
            }
        }
    }
}

const Branch& Hierarchy::of(int branch) const { return blueprint.branches[index(branch)]; }

std::vector<int> Hierarchy::tree(int branch) const {
    std::set<int> found{branch};
    std::vector<int> waiting{branch};
    while (!waiting.empty()) {
        const int next = waiting.back();
        waiting.pop_back();
        for (const auto& pair : subs[index(next)]) {
            if (found.insert(pair.second).second) {
                waiting.push_back(pair.second);
            }
        }
    }
    std::vector<int> sorted;
    for (const int one : order) {
        if (found.count(one)) {
            sorted.push_back(one);
        }
    }
    return sorted;
}

std::vector<int> Hierarchy::roots_of(int branch) const {
    std::vector<int> found;
    for (const int root : roots) {
        const std::vector<int> below = tree(root);
        if (std::find(below.begin(), below.end(), branch) != below.end()) {
            found.push_back(root);
        }
    }
    return found;
}

bool Hierarchy::is_active(int sub, int state) const { return state == of(sub).activating; }

int Hierarchy::rest(int sub, bool on) const { return on ? of(sub).activating : of(sub).initial; }

int Hierarchy::sub_at(int branch, int digit) const {
    for (const auto& [own, sub] : subs[index(branch)]) {
        if (own == digit) {
            return sub;
        }
    }
    return -1;
}

std::vector<Fact> Hierarchy::disagreements(const Configuration& configuration) const {
    std::vector<Fact> found;
    for (const int base : order) {
        for (const auto& [digit, sub] : subs[index(base)]) {
            const bool on = of(base).is_on(configuration[index(base)], digit);
            if (on != is_active(sub, configuration[index(sub)])) {
                found.emplace_back(base, digit);
            }
        }
    }
    return found;
}

std::map<int, int> Hierarchy::standing(int branch, int state) const {
    std::map<int, int> found{{branch, state}};
    for (const int one : tree(branch)) {
        for (const auto& [digit, sub] : subs[index(one)]) {
            found[sub] = rest(sub, of(one).is_on(found[one], digit));
        }
    }
    return found;
}

Configuration start_configuration(
    const Hierarchy& hierarchy, const std::map<int, int>& given, std::string& refused) {
    Configuration found(hierarchy.blueprint.branches.size(), 0);
    for (const int one : hierarchy.order) {
        const Branch& branch = hierarchy.of(one);
        const auto wanted = given.find(one);
        const std::vector<Fact>& bases = hierarchy.bases[index(one)];
        int start = branch.initial;
        std::vector<std::string> said;
        std::set<bool> votes;
        for (const auto& [base, digit] : bases) {
            const int state = found[index(base)];
            votes.insert(hierarchy.of(base).is_on(state, digit));
            said.push_back(
                hierarchy.of(base).name + "/" + hierarchy.of(base).states[index(state)].name +
                " (digit " + std::to_string(digit) + ")");
        }
        if (votes.size() == 2) {
            refused = "the bases of " + branch.name + " disagree about it: " + joined(said, ", ") +
                      ". Start them where the fact has one value";
            return found;
        }
        if (!bases.empty()) {
            start = hierarchy.rest(one, votes.count(true) > 0);
        }
        if (wanted != given.end()) {
            const bool agrees = hierarchy.is_active(one, wanted->second) ==
                                hierarchy.is_active(one, start);
            if (!bases.empty() && !agrees) {
                refused = "the start " + branch.name + "/" +
                          branch.states[index(wanted->second)].name + " disagrees with " +
                          joined(said, ", ");
                return found;
            }
            start = wanted->second;
        }
        found[index(one)] = start;
    }
    return found;
}

bool holds(const Configuration& configuration, const std::vector<Goal>& goals) {
    return std::all_of(goals.begin(), goals.end(), [&](const Goal& goal) {
        return configuration[index(goal.first)] == goal.second;
    });
}

namespace {

// Whether every SB has a state left, if states that agree with no remaining state of a neighbour
// are removed until nothing changes.
bool have_places(const Hierarchy& hierarchy, const std::map<int, int>& goals) {
    std::vector<std::set<int>> left;
    for (std::size_t at = 0; at < hierarchy.blueprint.branches.size(); ++at) {
        const auto goal = goals.find(static_cast<int>(at));
        std::set<int> states;
        if (goal != goals.end()) {
            states.insert(goal->second);
        } else {
            for (std::size_t one = 0; one < hierarchy.blueprint.branches[at].states.size(); ++one) {
                states.insert(static_cast<int>(one));
            }
        }
        left.push_back(states);
    }
    bool shrinks = true;
    while (shrinks) {
        shrinks = false;
        for (const int base : hierarchy.order) {
            for (const auto& [digit, sub] : hierarchy.subs[index(base)]) {
                std::set<bool> could;
                for (const int one : left[index(sub)]) {
                    could.insert(hierarchy.is_active(sub, one));
                }
                std::set<int> states;
                std::set<bool> on;
                for (const int one : left[index(base)]) {
                    if (could.count(hierarchy.of(base).is_on(one, digit))) {
                        states.insert(one);
                        on.insert(hierarchy.of(base).is_on(one, digit));
                    }
                }
                std::set<int> below;
                for (const int one : left[index(sub)]) {
                    if (on.count(hierarchy.is_active(sub, one))) {
                        below.insert(one);
                    }
                }
                shrinks = shrinks || states != left[index(base)] || below != left[index(sub)];
                left[index(base)] = states;
                left[index(sub)] = below;
            }
        }
        if (std::any_of(left.begin(), left.end(), [](const auto& one) { return one.empty(); })) {
            return false;
        }
    }
    return true;
}

std::string contradiction(const Hierarchy& hierarchy, const std::map<int, int>& goals) {
    std::map<int, std::pair<bool, std::string>> forced;
    for (const int one : hierarchy.order) {
        const Branch& branch = hierarchy.of(one);
        const auto up = forced.find(one);
        const auto goal = goals.find(one);
        if (goal != goals.end() && up != forced.end() &&
            up->second.first != (goal->second == branch.activating)) {
            return "the goal " + branch.name + "/" + branch.states[index(goal->second)].name +
                   " cannot hold with the goal " + up->second.second;
        }
        const bool active = up != forced.end() && up->second.first;
        if (goal == goals.end() && !active) {
            continue;
        }
        const int state = goal != goals.end() ? goal->second : branch.activating;
        const std::string cause = goal != goals.end()
                                      ? branch.name + "/" + branch.states[index(state)].name
                                      : up->second.second;
        for (const auto& [digit, sub] : hierarchy.subs[index(one)]) {
            const bool on = branch.is_on(state, digit);
            const auto known = forced.emplace(sub, std::make_pair(on, cause)).first;
            if (known->second.first != on) {
                return "the goals " + known->second.second + " and " + cause +
                       " cannot hold together: " + hierarchy.of(sub).name +
                       " cannot be both on and off";
            }
        }
    }
    if (goals.size() < 2) {
        return "";
    }
    std::vector<std::string> named;
    for (const auto& [branch, state] : goals) {
        if (!have_places(hierarchy, {{branch, state}})) {
            return "";
        }
        named.push_back(
            hierarchy.of(branch).name + "/" + hierarchy.of(branch).states[index(state)].name);
    }
    if (have_places(hierarchy, goals)) {
        return "";
    }
    return "the goals " + joined(named, " and ") +
           " cannot hold together: bases and subs cannot agree";
}

}  // namespace

std::vector<Goal> goals_of(
    const Hierarchy& hierarchy, const std::map<int, int>& asked, std::string& refused) {
    refused = contradiction(hierarchy, asked);
    std::map<int, int> wanted = asked;
    if (asked.empty()) {
        for (const int root : hierarchy.roots) {
            wanted[root] = hierarchy.of(root).activating;
        }
    }
    std::vector<int> level(hierarchy.order.size(), 0);
    for (const int one : hierarchy.order) {
        for (const auto& base : hierarchy.bases[index(one)]) {
            level[index(one)] = std::max(level[index(one)], level[index(base.first)] + 1);
        }
    }
    std::vector<Goal> goals(wanted.begin(), wanted.end());
    std::stable_sort(goals.begin(), goals.end(), [&](const Goal& one, const Goal& other) {
        return level[index(one.first)] < level[index(other.first)];
    });
    return goals;
}

}  // namespace dsfo
