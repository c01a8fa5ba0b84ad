#include "course.hpp"

#include <algorithm>

namespace dsfo {

namespace {

std::size_t index(int number) { return static_cast<std::size_t>(number); }

Shut merged(Shut first, const Shut& second) {
    for (const auto& [edge, why] : second) {
        first[edge] = why;
    }
    return first;
}

std::vector<std::string> keys_of(const Shut& shut) {
    std::vector<std::string> found;
    for (const auto& one : shut) {
        found.push_back(one.first);
    }
    return found;
}

}  // namespace

std::string goal_text(const Hierarchy& hierarchy, const Goal& goal) {
    const Branch& branch = hierarchy.of(goal.first);
    return address({branch.name, branch.states[index(goal.second)].name});
}

Course::Course(
    const Hierarchy& hierarchy, std::vector<Goal> its_goals,
    const std::vector<std::string>& avoid)
    : goals(std::move(its_goals)), hierarchy_(hierarchy), edges_(hierarchy) {
    for (const std::string& edge : avoid) {
        shut[edge] = "avoided";
    }
}

// permissions ---------------------------------------------------------------------------------------

void Course::prune(const std::string& edge, const std::string& reason) {
    shut[edge] = reason.empty() ? "pruned" : "pruned: " + reason;
    changed();
}

bool Course::restore(const std::string& edge) {
    const std::size_t known = shut.erase(edge) + risky.erase(edge) + vetoed.erase(edge);
    changed();
    return known > 0;
}

void Course::tag_risky(const std::string& edge, const std::string& reason) {
    risky[edge] = reason;
    changed();
}

void Course::veto(const std::string& edge, const Configuration& here) {
    if (vetoed_at_ != here) {
        vetoed.clear();
    }
    vetoed_at_ = here;
    vetoed[edge] = "vetoed";
    changed();
}

void Course::lift_vetoes(const std::vector<std::string>& edges) {
    for (const std::string& edge : edges) {
        if (vetoed.erase(edge) > 0) {
            planners_.clear();
        }
    }
}

bool Course::set_cost(const std::string& edge, double cost) {
    const double before = edges_.price(edge);
    if (before >= cost && before <= cost) {
        return false;
    }
    edges_.set_price(edge, cost);
    changed();
    return true;
}

Shut Course::closed() const {
    Shut found;
    for (const auto& [edge, why] : risky) {
        found[edge] = "risky: " + why;
    }
    return merged(merged(found, vetoed), shut);
}

// the plan ------------------------------------------------------------------------------------------

Planner& Course::planner(const std::string& what, const Shut& own) {
    std::unique_ptr<Planner>& known = planners_[what];
    if (!known) {
        known = std::make_unique<Planner>(hierarchy_, edges_, own);
    }
    return *known;
}

void Course::changed() {
    planners_.clear();
    drop_plan();
}

void Course::drop_plan() {
    legs_.clear();
    leg_ = 0;
    step_ = 0;
}

StepAnswer Course::asked(const Configuration& here, const Edge& edge) {
    const std::string& at = edge.address;
    if (shut.count(at) || (edge.fails.empty() && !risky.count(at) && !vetoed.count(at))) {
        Stepper& stepper = planner("now", closed()).stepper;
        stepper.renew();
        return stepper.step(here, edge);
    }
    Shut others = closed();
    others.erase(at);
    return Stepper(hierarchy_, edges_, others, {at}).step(here, edge);
}

Next Course::next_step(const Configuration& here) {
    if (!vetoed.empty() && vetoed_at_ != here) {
        lift_vetoes(keys_of(vetoed));
    }
    return next(here, planner("now", closed()));
}

Next Course::next(const Configuration& here, Planner& planner) {
    bool fresh = false;
    if (leg_ < legs_.size() && step_ == legs_[leg_].steps.size()) {
        ++leg_;
        step_ = 0;
        fresh = true;
    }
    if (leg_ >= legs_.size() || legs_[leg_].before[step_] != here) {
        bool gave_up = false;
        const std::optional<Legs> found = planner.legs(here, goals, gave_up);
        drop_plan();
        if (gave_up || !found || found->empty()) {
            return Next{nullptr, nullptr, gave_up};
        }
        legs_ = *found;
        fresh = true;
    }
    const StepPointer step = legs_[leg_].steps[step_++];
    return Next{step, fresh ? &legs_[leg_] : nullptr, false};
}

std::vector<const Edge*> Course::ahead() const {
    std::vector<const Edge*> found;
    for (std::size_t at = leg_; at < legs_.size(); ++at) {
        for (std::size_t one = at == leg_ ? step_ : 0; one < legs_[at].steps.size(); ++one) {
            const std::vector<const Edge*>& more = legs_[at].steps[one]->edges;
            found.insert(found.end(), more.begin(), more.end());
        }
    }
    return found;
}

std::string Course::next_operation(const Configuration& here) {
    if (holds(here, goals)) {
        return "";
    }
    const Legs legs = legs_;
    const std::size_t leg = leg_;
    const std::size_t step = step_;
    const bool stale = !vetoed.empty() && vetoed_at_ != here;
    Shut lasting;
    for (const auto& [edge, why] : closed()) {
        if (!vetoed.count(edge)) {
            lasting[edge] = why;
        }
    }
    const Next found = stale ? next(here, planner("lasting", merged(lasting, shut)))
                             : next(here, planner("now", closed()));
    legs_ = legs;
    leg_ = leg;
    step_ = step;
    return found.step ? found.step->asked->address : "";
}

std::vector<std::string> Course::risky_way(const Configuration& here) {
    std::vector<std::string> found;
    if (risky.empty()) {
        return found;
    }
    bool gave_up = false;
    const std::optional<Legs> legs =
        planner("risky", merged(vetoed, shut)).legs(here, goals, gave_up);
    for (const Leg& leg : legs.value_or(Legs{})) {
        for (const std::string& edge : leg.operations()) {
            if (risky.count(edge) && std::find(found.begin(), found.end(), edge) == found.end()) {
                found.push_back(edge);
            }
        }
    }
    return found;
}

}  // namespace dsfo
