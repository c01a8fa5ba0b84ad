#include "planner.hpp"

#include <algorithm>

#include "estimate.hpp"

namespace dsfo {

namespace {

std::size_t index(int number) { return static_cast<std::size_t>(number); }

}  // namespace

std::string Leg::aim(const Hierarchy& hierarchy) const {
    if (!goal) {
        return "a state without failure";
    }
    const Branch& branch = hierarchy.of(goal->first);
    return address({branch.name, branch.states[index(goal->second)].name});
}

double Leg::cost() const {
    double found = 0.0;
    for (const StepPointer& step : steps) {
        found += step->cost;
    }
    return rounded(found);
}

std::vector<std::string> Leg::operations() const {
    std::vector<std::string> found;
    for (const StepPointer& step : steps) {
        for (const Edge* edge : step->edges) {
            found.push_back(edge->address);
        }
    }
    return found;
}

void Leg::apply(Configuration& configuration) const {
    for (const StepPointer& step : steps) {
        step->after.apply(configuration);
    }
}

Planner::Planner(const Hierarchy& hierarchy, const Edges& edges, Shut shut)
    : stepper(hierarchy, edges, std::move(shut)), hierarchy_(hierarchy), edges_(edges) {
    for (const int one : hierarchy.order) {
        const std::set<int> asked = edges.requiring(one);
        required_.insert(asked.begin(), asked.end());
        for (const auto& [name, terms] : hierarchy.of(one).operations) {
            (void)name;
            if (!terms.requires_facts.empty()) {
                asking_.insert(one);
            }
        }
    }
    for (const Hazard& hazard : hierarchy.blueprint.hazards) {
        for (const auto& fact : hazard.facts) {
            in_hazards_.insert(fact.first.first);
        }
    }
}

std::optional<Legs> Planner::legs(
    const Configuration& start, const std::vector<Goal>& goals, bool& gave_up) {
    stepper.renew();
    gave_up_ = false;
    std::optional<Legs> found = way(start, goals);
    std::size_t count = 0;
    std::size_t facts = 0;
    for (const Leg& leg : found.value_or(Legs{})) {
        for (const StepPointer& step : leg.steps) {
            count += std::max<std::size_t>(step->actions.size(), 1);
        }
    }
    for (const Branch& branch : hierarchy_.blueprint.branches) {
        facts += branch.flags.size();
    }
    const std::size_t most =
        std::min<std::size_t>(5000, 300000 / std::max<std::size_t>(facts, 1));
    gave_up = gave_up_ || count > most;
    return found;
}

std::optional<Legs> Planner::way(const Configuration& start, const std::vector<Goal>& goals) {
    for (const Hazard& hazard : hierarchy_.blueprint.hazards) {
        if (hierarchy_.blueprint.meets(hazard, start)) {
            return std::nullopt;
        }
    }
    if (holds(start, goals)) {
        return Legs{};
    }
    bool fails = false;
    for (const int one : movers(goals)) {
        fails = fails || !hierarchy_.of(one).states[index(start[index(one)])].fails.empty();
    }
    if (!fails) {
        return to_goals(start, goals);
    }
    const std::optional<Leg> first = leg(start, std::nullopt, {}, goals, false);
    if (!first) {
        return std::nullopt;
    }
    Configuration after = start;
    first->apply(after);
    std::optional<Legs> onward = to_goals(after, goals);
    if (onward) {
        onward->insert(onward->begin(), *first);
        return onward;
    }
    const std::optional<Leg> last = leg(start, goals.back(), goals, goals, true);
    return last ? std::optional<Legs>(Legs{*last}) : std::nullopt;
}

std::optional<Legs> Planner::to_goals(const Configuration& start, const std::vector<Goal>& goals) {
    Legs found;
    Configuration here = start;
    for (std::size_t at = 0; at < goals.size(); ++at) {
        const std::vector<Goal> wanted(goals.begin(), goals.begin() + static_cast<long>(at) + 1);
        if (holds(here, wanted)) {
            continue;
        }
        const std::optional<Leg> next = leg(here, goals[at], wanted, {goals[at]}, false);
        if (!next) {
            if (goals.size() == 1) {
                return std::nullopt;
            }
            const std::optional<Leg> last = leg(start, goals.back(), goals, goals, false);
            return last ? std::optional<Legs>(Legs{*last}) : std::nullopt;
        }
        found.push_back(*next);
        next->apply(here);
    }
    return found;
}

std::vector<int> Planner::movers(const std::vector<Goal>& goals) const {
    std::set<int> moving;
    for (const Goal& goal : goals) {
        for (const int root : hierarchy_.roots_of(goal.first)) {
            const std::vector<int> below = hierarchy_.tree(root);
            moving.insert(below.begin(), below.end());
        }
    }
    std::vector<int> found;
    for (const int one : hierarchy_.order) {
        if (moving.count(one)) {
            found.push_back(one);
        }
    }
    return found;
}

std::optional<Leg> Planner::leg(
    const Configuration& start, const std::optional<Goal>& goal, const std::vector<Goal>& wanted,
    const std::vector<Goal>& all, bool clean) {
    const std::vector<int> moving = movers(all);
    std::set<int> ill;
    std::set<int> seen;
    for (const int one : moving) {
        const std::vector<State>& states = hierarchy_.of(one).states;
        const bool fails = std::any_of(
            states.begin(), states.end(), [](const State& state) { return !state.fails.empty(); });
        if (fails && (clean || !goal)) {
            ill.insert(one);
        }
    }
    seen = ill;
    for (const Goal& one : wanted) {
        seen.insert(one.first);
    }
    const std::set<int> quiet = quiet_ones(moving, seen);
    const int routed = goal ? goal->first : moving.front();
    const auto is_goal = [&](const Configuration& node) {
        return holds(node, wanted) && std::all_of(ill.begin(), ill.end(), [&](int one) {
                   return hierarchy_.of(one).states[index(node[index(one)])].fails.empty();
               });
    };
    const Found found = cheapest(
        start, is_goal,
        [&](const Configuration& node, std::vector<Move>& into) {
            return moves(node, moving, quiet, routed, into);
        },
        patience(hierarchy_.blueprint), Estimate(stepper, wanted, moving));
    gave_up_ = gave_up_ || found.gave_up;
    if (!found.any) {
        return std::nullopt;
    }
    Leg made;
    made.goal = goal;
    Configuration here = start;
    for (const Move& move : found.moves) {
        const StepAnswer step = stepper.step(here, *move.what);
        made.steps.push_back(std::get<StepPointer>(step));
        made.before.push_back(here);
        made.steps.back()->after.apply(here);
    }
    return made;
}

std::set<int> Planner::quiet_ones(
    const std::vector<int>& moving, const std::set<int>& seen) const {
    std::set<int> found;
    for (const int one : moving) {
        const bool asked = required_.count(one) || seen.count(one) || asking_.count(one) ||
                           in_hazards_.count(one);
        if (!asked && !hierarchy_.bases[index(one)].empty() &&
            hierarchy_.subs[index(one)].empty()) {
            found.insert(one);
        }
    }
    return found;
}

bool Planner::moves(
    const Configuration& node, const std::vector<int>& moving, const std::set<int>& quiet,
    int routed, std::vector<Move>& found) {
    std::size_t seen = 0;
    for (const int one : moving) {
        const std::vector<Edge>& every = edges_.out(one, node[index(one)]);
        seen += every.size();
        for (const Edge& edge : every) {
            if (edge.source == edge.target || (quiet.count(one) && edge.crossing >= 0)) {
                continue;
            }
            Move move;
            move.to = node;
            move.key = {hierarchy_.place[index(one)], edge.name};
            move.what = &edge;
            if (edge.kind == Kind::pure && edge.crossing == 0) {
                move.to[index(one)] = edge.target;
                move.cost = edge.cost;
                const std::vector<Hazard>& hazards = hierarchy_.blueprint.hazards;
                const bool endangers =
                    in_hazards_.count(one) &&
                    std::any_of(hazards.begin(), hazards.end(), [&](const Hazard& hazard) {
                        return hierarchy_.blueprint.meets(hazard, move.to);
                    });
                if (endangers || !stepper.allows(node, edge)) {
                    continue;
                }
                if (one == routed) {
                    move.names = {edge.name};
                }
            } else {
                const StepAnswer answer = stepper.step(node, edge);
                const auto* step = std::get_if<StepPointer>(&answer);
                if (step == nullptr) {
                    continue;
                }
                (*step)->after.apply(move.to);
                move.cost = (*step)->cost;
                move.names = (*step)->names(routed);
            }
            move.number = static_cast<int>(move.names.size());
            found.push_back(move);
        }
    }
    return stepper.spend(seen);
}

}  // namespace dsfo
