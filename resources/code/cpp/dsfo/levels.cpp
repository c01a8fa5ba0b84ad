#include "levels.hpp"

#include <algorithm>

namespace dsfo {

namespace {

bool asks(const Operation& terms) { return !terms.actor.empty() || !terms.confirm.empty(); }

// Whether `SB/name` names a fact. It then names no operation.
bool is_digit(const Branch& branch, const std::string& name) {
    const auto fact = split_fact("SB/" + name);
    return fact && fact->second < static_cast<int>(branch.flags.size()) &&
           std::to_string(fact->second) == name;
}

}  // namespace

Levels::Levels(const Hierarchy& hierarchy, std::map<std::string, std::string> before)
    : hierarchy_(hierarchy), before_(std::move(before)) {
    const Blueprint& blueprint = hierarchy.blueprint;
    declared_.insert(blueprint.levels.begin(), blueprint.levels.end());
    inspection = level_of({"inspection"}, "automatic");
    supervision = level_of({"supervision"}, "shared");
    std::set<std::string> named;
    for (const auto* said : {&before_, &declared_}) {
        for (const auto& [key, level] : *said) {
            if (!level.empty() && key.find('/') != std::string::npos) {
                named.insert(parts(key).front());
            }
        }
    }
    for (std::size_t at = 0; at < blueprint.branches.size(); ++at) {
        const Branch& own = blueprint.branches[at];
        const bool asking = std::any_of(
            own.operations.begin(), own.operations.end(),
            [](const auto& one) { return asks(one.second); });
        if (asking || named.count(own.name)) {
            people_do_.insert(static_cast<int>(at));
        }
    }
}

std::string Levels::level_of(
    const std::vector<std::string>& keys, const std::string& usual) const {
    for (const auto* said : {&before_, &declared_}) {
        for (const std::string& key : keys) {
            const auto found = said->find(key);
            if (found != said->end()) {
                return found->second;
            }
        }
    }
    return usual;
}

std::string Levels::operation(const Edge& edge) const {
    const Branch& own = hierarchy_.of(edge.branch);
    std::vector<std::string> keys{edge.address};
    if (!is_digit(own, edge.name)) {
        keys.push_back(address({own.name, edge.name}));
    }
    return level_of(keys, edge.terms->actor.empty() ? "automatic" : edge.terms->actor);
}

std::string Levels::fact(Fact fact) const {
    const Blueprint& blueprint = hierarchy_.blueprint;
    const bool people = blueprint.flag(fact).told_by_people;
    return level_of({blueprint.fact_text(fact)}, people ? "human" : "automatic");
}

bool Levels::people_do(int branch) const { return people_do_.count(branch) > 0; }

bool Levels::by_person(const Edge& edge) const {
    return edge.acts && people_do(edge.branch) && operation(edge) == "human";
}

std::string no_level(
    const Hierarchy& hierarchy, const std::string& key, const std::string& level) {
    if (level != "human" && level != "shared" && level != "automatic") {
        return "'" + level + "' is no level of " + key +
               ". Choose one of human, shared, automatic.";
    }
    if (key == "inspection" || key == "supervision") {
        return "";
    }
    const std::vector<std::string> names = parts(key);
    const int branch = hierarchy.blueprint.number_of(names.front());
    if (branch >= 0 && names.size() == 2 && is_digit(hierarchy.of(branch), names[1])) {
        const std::string& sub =
            hierarchy.of(branch).flags[static_cast<std::size_t>(std::stoi(names[1]))].sub;
        return sub.empty() ? "" : key + " has no level of its own: " + sub + " expands it";
    }
    for (const State& state : branch < 0 ? std::vector<State>{} : hierarchy.of(branch).states) {
        for (const auto& one : state.operations) {
            const bool by_name = names.size() == 2 && names[1] == one.first;
            if (by_name ||
                (names.size() == 3 && names[1] == state.name && names[2] == one.first)) {
                return "";
            }
        }
    }
    return "'" + key + "' has no level: it is no operation and no fact";
}

}  // namespace dsfo
