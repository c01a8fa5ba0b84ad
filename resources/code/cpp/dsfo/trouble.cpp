#include "trouble.hpp"

#include <algorithm>

namespace dsfo {

namespace {

std::size_t index(int number) { return static_cast<std::size_t>(number); }

constexpr std::size_t most_named = 8;  // configurations that are named as fitting the scene

}  // namespace

void Trouble::blame(const JointStep& step, const Failure& failure) {
    std::vector<const Edge*> blamed;
    if (failure.risky) {
        blamed.push_back(failure.edge);
        for (const Edge* edge : step.edges) {
            const bool root = run_.hierarchy.bases[index(edge->branch)].empty();
            if (root && std::find(blamed.begin(), blamed.end(), edge) == blamed.end()) {
                blamed.push_back(edge);
            }
        }
    }
    for (const Edge* edge : blamed) {
        course_.tag_risky(edge->address, failure.reason);
        Object said = run_.event("operation_risky");
        run_.tell(said.text("address", edge->address).text("reason", failure.reason));
    }
    course_.drop_plan();
    run_.drop_pending();
}

// If a move of the sub-SB alone explains the scene, it is adopted.
std::optional<Hold> Trouble::after(const Failure& failure) {
    if (failure.hazards || !failure.lost.empty()) {
        return lost(failure.lost, failure.reason, failure.hazards ? "hazard" : "guard_lost");
    }
    if (!failure.pending && !run_.stands(run_.configuration)) {
        if (const auto alone = sub_alone(failure.edge->branch)) {
            adopt(*alone);
            return std::nullopt;
        }
    }
    return relocalise(failure.reason);
}

// Nothing is adopted.
Hold Trouble::lost(
    const std::vector<std::string>& facts, const std::string& cause, const std::string& kind) {
    Hold why{cause.empty() ? joined(facts, "; ") : cause, facts, kind, {}};
    if (const auto found = relocalise("", false)) {
        for (const std::string& detail : found->details) {
            if (std::find(why.details.begin(), why.details.end(), detail) == why.details.end()) {
                why.details.push_back(detail);
            }
        }
    }
    return why;
}

// A run that only observes is not located.
Hold Trouble::endangered(const std::vector<Hazard>& hazards, bool observes) {
    const std::vector<std::string> facts = run_.met_words(hazards);
    return observes ? Hold{joined(facts, "; "), facts, "hazard", {}} : lost(facts, "", "hazard");
}

std::optional<Hold> Trouble::unconfirmed(const std::vector<Goal>& goals) {
    std::optional<Hold> found = relocalise();
    std::vector<std::string> failed;
    for (const Goal& goal : goals) {
        const Check check = run_.check(goal.first, goal.second);
        if (!check.is_true()) {
            failed.push_back(run_.why_not(check));
        }
    }
    if (found && !failed.empty()) {
        found->reason = "The goal is not confirmed: " + joined(failed, "; ");
        found->kind = "goal_unconfirmed";
    }
    return found;
}

std::optional<Hold> Trouble::relocalise(const std::string& cause, bool adopts) {
    candidates.clear();
    run_.drop_pending();
    run_.look();
    if (run_.stands(run_.configuration)) {
        const std::string here = run_.json_of(run_.configuration);
        run_.tell(run_.event("relocalised").raw("configuration", here));
        return std::nullopt;
    }
    const std::vector<Check> checks = run_.checks(run_.configuration);
    const std::vector<std::string> facts = run_.odd_words(checks);
    candidates = agreeing(false);
    std::string listed;
    for (const Configuration& one : candidates) {
        listed += (listed.empty() ? "" : ",") + run_.json_of(one);
    }
    Object said = run_.event("mismatch");
    said.raw("facts", json_list(facts));
    run_.tell(said.raw("candidates", "[" + listed + "]"));
    if (adopts && adopts_ && run_.met().empty() && candidates.size() == 1 &&
        run_.stands(candidates.front())) {
        adopt(Configuration(candidates.front()));
        return std::nullopt;
    }
    const auto first = std::find_if(
        checks.begin(), checks.end(), [](const Check& check) { return !check.is_true(); });
    return Hold{cause.empty() ? run_.why_not(*first) : cause, facts, "held", {}};
}

void Trouble::adopt(const Configuration& configuration) {
    run_.configuration = configuration;
    candidates.clear();
    course_.drop_plan();
    const std::string here = run_.json_of(run_.configuration);
    run_.tell(run_.event("relocalised").raw("configuration", here));
}

// which configurations fit the scene ----------------------------------------------------------------

std::vector<Configuration> Trouble::located() const { return agreeing(true); }

std::vector<int> Trouble::true_states(int branch, const Configuration& all) const {
    Configuration mine = all;
    mine[index(branch)] = run_.configuration[index(branch)];
    for (const Check& check : run_.checks(mine)) {
        if (check.branch == branch && check.is_true()) {
            return {mine[index(branch)]};
        }
    }
    return run_.fitting(branch, all);
}

// The consistent configurations made of states that fit: sub-SBs first, then the bases decide which
// of its states a sub-SB may be in.
std::vector<Configuration> Trouble::agreeing(bool from_scene) const {
    const Hierarchy& known = run_.hierarchy;
    Configuration all = run_.configuration;
    std::map<int, std::vector<int>> found;
    for (auto one = known.order.rbegin(); one != known.order.rend(); ++one) {
        found[*one] = from_scene ? run_.fitting(*one, all) : true_states(*one, all);
        if (found[*one].empty()) {
            return {};
        }
        all[index(*one)] = found[*one].front();
    }
    for (const int one : known.order) {
        for (const auto& [base, digit] : known.bases[index(one)]) {
            const bool on = known.of(base).is_on(found[base].front(), digit);
            std::vector<int>& states = found[one];
            states.erase(
                std::remove_if(
                    states.begin(), states.end(),
                    [&, one = one](int state) { return known.is_active(one, state) != on; }),
                states.end());
            if (states.empty()) {
                return {};
            }
        }
    }
    std::vector<Configuration> every{run_.configuration};
    for (const int one : known.order) {
        std::vector<Configuration> more;
        for (const Configuration& start : every) {
            for (const int state : found[one]) {
                if (more.size() < most_named) {
                    more.push_back(start);
                    more.back()[index(one)] = state;
                }
            }
        }
        every = more;
    }
    std::vector<Configuration> standing;
    std::copy_if(
        every.begin(), every.end(), std::back_inserter(standing),
        [this](const Configuration& one) { return run_.stands(one); });
    return standing;
}

std::optional<Configuration> Trouble::sub_alone(int branch) const {
    const std::vector<int> states = true_states(branch, run_.configuration);
    if (run_.hierarchy.bases[index(branch)].empty() || states.size() != 1) {
        return std::nullopt;
    }
    Configuration moved = run_.configuration;
    moved[index(branch)] = states.front();
    if (!run_.hierarchy.disagreements(moved).empty() || !run_.stands(moved)) {
        return std::nullopt;
    }
    return moved;
}

// no route ------------------------------------------------------------------------------------------

Hold Trouble::no_way() {
    std::string goal;
    for (const Goal& one : course_.goals) {
        if (goal.empty() && run_.configuration[index(one.first)] != one.second) {
            goal = goal_text(run_.hierarchy, one);
        }
    }
    const std::vector<std::string> risky = course_.risky_way(run_.configuration);
    std::vector<std::string> details;
    if (!risky.empty()) {
        for (const std::string& edge : risky) {
            details.push_back(edge + ": " + course_.risky[edge]);
        }
        return Hold{
            "Only risky operations lead to " + goal + ": " + joined(risky, ", ") + ".", details,
            "held", {}};
    }
    std::vector<std::string> here;
    std::vector<std::string> skipped;
    for (const int one : run_.hierarchy.order) {
        const int state = run_.configuration[index(one)];
        const Branch& branch = run_.hierarchy.of(one);
        here.push_back(branch.name + "/" + branch.states[index(state)].name);
        for (const Edge& edge : course_.edges().out(one, state)) {
            details.push_back(edge.address + ": " + hindrance(edge));
        }
    }
    for (const auto& one : course_.vetoed) {
        skipped.push_back(one.first);
    }
    return Hold{
        "Nothing permitted leads from " + joined(here, ", ") + " to " + goal + ".", details,
        "no_route", skipped};
}

std::string Trouble::hindrance(const Edge& edge) {
    const StepAnswer answer = course_.asked(run_.configuration, edge);
    if (const auto* no = std::get_if<Unavailable>(&answer)) {
        return joined(no->reasons, "; ");
    }
    const Shut closed = course_.closed();
    const auto why = closed.find(edge.address);
    return why != closed.end() ? "it is " + why->second
           : edge.fails.empty() ? "possible, but no way leads on from there"
                                : "no route uses it, it leads into a failure: " + edge.fails;
}

}  // namespace dsfo
