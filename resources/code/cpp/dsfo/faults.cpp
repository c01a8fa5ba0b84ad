#include "faults.hpp"

#include <algorithm>

namespace dsfo {

namespace {

struct Parameters {
    std::vector<std::string> needs;
    std::vector<std::string> may;
};

const std::map<std::string, Parameters>& faults() {
    static const std::map<std::string, Parameters> known{
        {"set", {{"fact", "value"}, {}}},  {"fail", {{}, {"operation"}}},
        {"raise", {{}, {"operation"}}},    {"hang", {{}, {"operation"}}},
        {"nothing", {{}, {"operation"}}},  {"elsewhere", {{"state"}, {"operation"}}}};
    return known;
}

bool has(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::string text_of(const std::map<std::string, Json>& given, const std::string& name) {
    const auto found = given.find(name);
    return found == given.end() ? "" : found->second.text;
}

bool is_operation(const Hierarchy& hierarchy, const std::string& text) {
    const std::vector<std::string> names = parts(text);
    const int branch = names.size() == 3 ? hierarchy.blueprint.number_of(names[0]) : -1;
    const int state = branch < 0 ? -1 : hierarchy.of(branch).number_of(names[1]);
    if (state < 0) {
        return false;
    }
    const auto& all = hierarchy.of(branch).states[static_cast<std::size_t>(state)].operations;
    return std::any_of(
        all.begin(), all.end(), [&names](const auto& one) { return one.first == names[2]; });
}

// The SB and the state that a text names; the SB may be left out where there is one root.
std::optional<std::pair<int, int>> state_in(const Hierarchy& hierarchy, const std::string& text) {
    const std::size_t slash = text.rfind('/');
    int branch = -1;
    if (slash != std::string::npos && slash > 0) {
        branch = hierarchy.blueprint.number_of(text.substr(0, slash));
    } else if (hierarchy.roots.size() == 1) {
        branch = hierarchy.roots.front();
    }
    const std::string name = slash == std::string::npos ? text : text.substr(slash + 1);
    const int state = branch < 0 ? -1 : hierarchy.of(branch).number_of(name);
    return state < 0 ? std::nullopt : std::make_optional(std::make_pair(branch, state));
}

}  // namespace

std::string fault_refused(const std::map<std::string, Json>& given) {
    const std::string fault = text_of(given, "fault");
    const auto known = faults().find(fault);
    if (known == faults().end()) {
        return "the world 'table' has no fault '" + fault + "'";
    }
    const Parameters& own = known->second;
    for (const std::string& name : own.needs) {
        if (!given.count(name)) {
            return "the fault " + fault + ": " + name + " is missing";
        }
    }
    for (const auto& [name, value] : given) {
        if (name != "fault" && !has(own.needs, name) && !has(own.may, name)) {
            return "the fault " + fault + ": there is no parameter '" + name + "'";
        }
        if (value.kind != Json::Kind::text) {
            return "the fault " + fault + ": " + name + " is not a text";
        }
    }
    return "";
}

std::string inject_fault(
    World& world, const Hierarchy& hierarchy, const std::map<std::string, Json>& given) {
    auto* const table = dynamic_cast<TableWorld*>(&world);
    const std::string wrong = fault_refused(given);
    if (!wrong.empty() || table == nullptr) {
        return wrong.empty() ? "only the table world has faults" : wrong;
    }
    const std::string fault = text_of(given, "fault");
    if (fault == "set") {
        const std::string text = text_of(given, "fact");
        const auto named = split_fact(text);
        const int branch = named ? hierarchy.blueprint.number_of(named->first) : -1;
        const Fact fact{branch, named ? named->second : 0};
        const std::vector<Fact> known = hierarchy.blueprint.sensed();
        if (std::find(known.begin(), known.end(), fact) == known.end()) {
            return "no fact called '" + text + "' is sensed. Write it as SB/digit, digits " +
                   "counted from 0.";
        }
        table->set_fact(fact, text_of(given, "value"));
        return "";
    }
    const std::string at = text_of(given, "operation");
    if (!at.empty() && !is_operation(hierarchy, at)) {
        return "there is no operation '" + at + "'. Write it as SB/State/Operation.";
    }
    std::optional<std::pair<int, int>> elsewhere;
    if (fault == "elsewhere") {
        const std::string text = text_of(given, "state");
        elsewhere = state_in(hierarchy, text);
        if (!elsewhere) {
            return "there is no state '" + text + "'. Write it as SB/State.";
        }
    }
    table->spoil(fault, at, elsewhere);
    return "";
}

}  // namespace dsfo
