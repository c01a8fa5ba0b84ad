#include "dispatcher.hpp"

#include <algorithm>

namespace dsfo {

namespace {

std::size_t index(int number) { return static_cast<std::size_t>(number); }

constexpr double hair = 1e-9;
constexpr int visits = 3;  // how often the route may begin one edge from one configuration
constexpr std::size_t most_named = 8;  // configurations that are named as fitting the scene

}  // namespace

Dispatcher::Dispatcher(const Hierarchy& hierarchy, World& world, Terms terms)
    : hierarchy_(hierarchy), world_(world), terms_(std::move(terms)), edges_(hierarchy) {
    for (const std::string& edge : terms_.avoid) {
        shut_[edge] = "avoided";
    }
}

std::string Dispatcher::goal_text(const Goal& goal) const {
    const Branch& branch = hierarchy_.of(goal.first);
    return address({branch.name, branch.states[index(goal.second)].name});
}

std::vector<std::string> Dispatcher::drained() {
    std::vector<std::string> found;
    std::swap(found, run_->events);
    return found;
}

// the start -----------------------------------------------------------------------------------------

std::vector<std::string> Dispatcher::open() {
    std::string refused;
    const Configuration start = start_configuration(hierarchy_, terms_.start, refused);
    run_ = std::make_unique<LiveRun>(hierarchy_, world_, start);
    std::vector<Hazard> hazards;
    for (const Hazard& hazard : hierarchy_.blueprint.hazards) {
        if (refused.empty() && hierarchy_.blueprint.meets(hazard, start)) {
            hazards.push_back(hazard);
        }
    }
    if (!hazards.empty()) {
        refused = "the start meets a hazard: " + joined(run_->met_words(hazards), "; ");
    }
    if (refused.empty()) {
        goals_ = goals_of(hierarchy_, terms_.goals, refused);
    }
    if (!refused.empty()) {
        refuse(refused);
        return drained();
    }
    world_.begin(start);
    if (run_->gone()) {
        refuse(world_.lost());
        return drained();
    }
    run_->look();
    const std::vector<Check> checks = run_->checks(run_->configuration);
    std::vector<std::string> failed;
    for (const Check& check : checks) {
        if (!check.is_true()) {
            failed.push_back(run_->why_not(check));
        }
    }
    const std::vector<Hazard> met = run_->met();
    if (!failed.empty() || !met.empty()) {
        run_->events.clear();
        refuse(
            !failed.empty() ? joined(failed, "; ")
                            : "the start meets a hazard: " + joined(run_->met_words(met), "; "));
        return drained();
    }
    tell_start(checks);
    return drained();
}

void Dispatcher::refuse(const std::string& sentence) {
    reason_ = "refused";
    Object said = run_->event("run_finished");
    said.text("reason", reason_).text("sentence", sentence + ".").count("operations", 0);
    run_->tell(said.raw("configuration", "{}"));
}

void Dispatcher::tell_start(const std::vector<Check>& checks) {
    std::vector<std::string> changes;
    std::swap(changes, run_->events);
    std::vector<std::string> goals;
    for (const Goal& goal : goals_) {
        goals.push_back(goal_text(goal));
    }
    std::map<std::pair<std::string, std::size_t>, std::string> sensed;
    for (std::size_t at = 0; at < hierarchy_.blueprint.branches.size(); ++at) {
        const Branch& own = hierarchy_.blueprint.branches[at];
        for (std::size_t digit = 0; digit < own.flags.size(); ++digit) {
            if (own.flags[digit].sub.empty()) {
                const Fact fact{static_cast<int>(at), static_cast<int>(digit)};
                sensed[{own.name, digit}] = hierarchy_.blueprint.fact_text(fact);
            }
        }
    }
    std::vector<std::string> names;
    for (const auto& [key, name] : sensed) {
        names.push_back(name);
    }
    Object said = run_->event("run_started");
    said.text("world", world_.name()).count("seed", terms_.seed);
    said.raw("start", run_->json_of(run_->configuration)).raw("goals", json_list(goals));
    said.text("behaviour", hierarchy_.blueprint.behaviour);
    run_->tell(said.raw("sensed", json_list(names)));
    for (const auto& [at, sentence] : hierarchy_.blueprint.left_out) {
        run_->tell(run_->event("left_out").text("address", at).text("sentence", sentence));
    }
    run_->events.insert(run_->events.end(), changes.begin(), changes.end());
    for (const Check& check : checks) {
        run_->tell_check(check);
    }
}

// one tick ------------------------------------------------------------------------------------------

std::vector<std::string> Dispatcher::tick() {
    if (finished() || !run_) {
        return {};
    }
    if (stopping_) {
        stop_now();
    } else if (carrier_) {
        carry();
    } else {
        propose();
    }
    if (!finished() && run_->gone()) {
        lose();
    }
    return drained();
}

void Dispatcher::propose() {
    if (lost() || endangered()) {
        return;
    }
    if (at_a_goal()) {
        if (!since_) {
            since_ = run_->time();
        }
        run_->pass_tick();
        if (!run_->gone()) {
            look_at_goals();
        }
        return;
    }
    std::optional<Hold> why;
    const StepPointer step = next_step(why);
    if (why) {
        hold(*why);
    } else {
        admit(step);
    }
}

std::vector<Goal> Dispatcher::reached() const {
    std::vector<Goal> found;
    for (const Goal& goal : goals_) {
        if (run_->configuration[index(goal.first)] != goal.second) {
            break;
        }
        found.push_back(goal);
    }
    return found;
}

bool Dispatcher::at_a_goal() const {
    const std::vector<Goal> here = reached();
    return here.size() == goals_.size() ||
           std::any_of(here.begin(), here.end(), [this](const Goal& goal) {
               return told_.count(goal) == 0;
           });
}

// A goal is told only after a fresh check (clause 9).
void Dispatcher::look_at_goals() {
    run_->look();
    if (endangered() || lost()) {
        return;
    }
    const std::vector<Goal> here = reached();
    std::vector<std::string> doubtful;
    for (const Goal& goal : here) {
        const Check check = run_->check(goal.first, goal.second);
        if (!check.is_true()) {
            doubtful.push_back(run_->why_not(check));
        }
    }
    if (!doubtful.empty() || !run_->broken().empty()) {
        if (run_->time() - *since_ >= world_.settle() - hair) {
            since_.reset();
            std::optional<Hold> found = relocalise("", terms_.adopts);
            if (found && !doubtful.empty()) {
                found->reason = "The goal is not confirmed: " + joined(doubtful, "; ");
                found->kind = "goal_unconfirmed";
            }
            if (found) {
                hold(*found);
            }
        }
        return;
    }
    since_.reset();
    std::vector<std::string> names;
    for (const Goal& goal : here) {
        names.push_back(goal_text(goal));
        if (told_.insert(goal).second) {
            run_->tell(run_->event("goal_reached").text("goal", goal_text(goal)));
            begun_.clear();
        }
    }
    if (here.size() == goals_.size()) {
        finish("goal_reached", joined(names, ", ") + (names.size() == 1 ? " holds." : " hold."));
    }
}

Shut Dispatcher::closed() const {
    Shut found = shut_;
    for (const auto& [edge, why] : risky_) {
        found.emplace(edge, "risky: " + why);
    }
    return found;
}

StepPointer Dispatcher::next_step(std::optional<Hold>& why) {
    bool fresh = false;
    if (leg_ < legs_.size() && step_ == legs_[leg_].steps.size()) {
        ++leg_;
        step_ = 0;
        fresh = true;
    }
    if (leg_ >= legs_.size() || legs_[leg_].before[step_] != run_->configuration) {
        if (!planner_) {
            planner_ = std::make_unique<Planner>(hierarchy_, edges_, closed());
        }
        bool gave_up = false;
        const std::optional<Legs> found = planner_->legs(run_->configuration, goals_, gave_up);
        legs_.clear();
        leg_ = 0;
        step_ = 0;
        if (gave_up) {
            why = Hold{"Planning was given up: the search takes too much.", {}};
            return nullptr;
        }
        if (!found || found->empty()) {
            why = no_way();
            return nullptr;
        }
        legs_ = *found;
        fresh = true;
    }
    const StepPointer step = legs_[leg_].steps[step_++];
    if (fresh) {
        const Leg& leg = legs_[leg_];
        Object said = run_->event("route_planned");
        said.text("goal", leg.aim(hierarchy_)).raw("operations", json_list(leg.operations()));
        run_->tell(said.number("cost", leg.cost()));
        std::vector<const Edge*> ahead = step->edges;
        for (std::size_t at = leg_; at < legs_.size(); ++at) {
            for (std::size_t one = at == leg_ ? step_ : 0; one < legs_[at].steps.size(); ++one) {
                const std::vector<const Edge*>& more = legs_[at].steps[one]->edges;
                ahead.insert(ahead.end(), more.begin(), more.end());
            }
        }
        tell_bypasses(ahead);
    }
    return step;
}

// Edges that set the facts of their sub-SBs by themselves are told before they are taken.
void Dispatcher::tell_bypasses(const std::vector<const Edge*>& edges) {
    for (const Edge* edge : edges) {
        if (!edge->load || !bypassed_.insert(edge->address).second) {
            continue;
        }
        std::vector<std::string> subs;
        std::vector<std::string> facts;
        const Branch& own = hierarchy_.of(edge->branch);
        for (const auto& [digit, sub] : hierarchy_.subs[index(edge->branch)]) {
            if (std::count(edge->falls.begin(), edge->falls.end(), digit) +
                    std::count(edge->rises.begin(), edge->rises.end(), digit) ==
                0) {
                continue;
            }
            facts.push_back(own.fact_name(digit));
            for (const int below : hierarchy_.tree(sub)) {
                const std::string& name = hierarchy_.of(below).name;
                if (std::find(subs.begin(), subs.end(), name) == subs.end()) {
                    subs.push_back(name);
                }
            }
        }
        const std::string title = edge->terms->title.empty() ? edge->name : edge->terms->title;
        Object said = run_->event("subs_bypassed");
        said.text("address", edge->address).raw("subs", json_list(subs));
        run_->tell(said.text(
            "sentence", "Goes by " + title + ": it sets " + joined(facts, " and ") + " of " +
                            own.name + " by itself, and no operation of " +
                            joined(subs, " and ") + " is carried out."));
    }
}

// guards, then motion (clause 4) --------------------------------------------------------------------

void Dispatcher::admit(const StepPointer& step) {
    const std::string& asked = step->asked->address;
    std::vector<std::string> reasons = run_->refusals(*step);
    std::string hazard;
    if (reasons.empty()) {
        if (const auto found = run_->objection(asked, step->actions)) {
            reasons = {found->sentence};
            hazard = found->hazard;
        }
    }
    if (!reasons.empty()) {
        legs_.clear();
        Object said = run_->event("operation_refused");
        said.text("address", asked).raw("reasons", json_list(reasons));
        if (!hazard.empty()) {
            said.text("code", "hazard").text("hazard", hazard);
        }
        run_->tell(said);
        hold(Hold{asked + " cannot begin: " + reasons.front(), reasons,
                  hazard.empty() ? "held" : "hazard"});
        return;
    }
    if (const auto why = circling(*step->asked)) {
        legs_.clear();
        hold(Hold{*why, {}});
        return;
    }
    carrier_ = std::make_unique<Carrier>(*run_, step);
    carry();
}

std::optional<std::string> Dispatcher::circling(const Edge& edge) {
    int& count = begun_[{edge.address, run_->configuration}];
    if (count < visits) {
        ++count;
        return std::nullopt;
    }
    std::vector<std::string> here;
    for (const int one : hierarchy_.order) {
        const Branch& branch = hierarchy_.of(one);
        here.push_back(
            branch.name + "/" + branch.states[index(run_->configuration[index(one)])].name);
    }
    return edge.address + " was begun 3 times from " + joined(here, ", ") +
           " without getting further.";
}

void Dispatcher::carry() {
    carrier_->advance(shut_);
    if (carrier_->stage == Carrier::Stage::failed) {
        const std::unique_ptr<Carrier> carrier = std::move(carrier_);
        failed(carrier->step, carrier->failure);
    } else if (carrier_->stage == Carrier::Stage::done) {
        carrier_.reset();
        if (!endangered() && !run_->broken().empty()) {
            if (const auto why = relocalise("", terms_.adopts)) {
                hold(*why);
            }
        }
    }
    if (!carrier_ && !finished()) {
        since_ = run_->time();
    }
}

// failures (clauses 8 and 9) ------------------------------------------------------------------------

void Dispatcher::failed(const StepPointer& step, const Failure& failure) {
    std::vector<const Edge*> blamed;
    if (failure.risky) {
        blamed.push_back(failure.edge);
        for (const Edge* edge : step->edges) {
            const bool root = hierarchy_.bases[index(edge->branch)].empty();
            if (root && std::find(blamed.begin(), blamed.end(), edge) == blamed.end()) {
                blamed.push_back(edge);
            }
        }
    }
    for (const Edge* edge : blamed) {
        risky_[edge->address] = failure.reason;
        planner_.reset();
        Object said = run_->event("operation_risky");
        run_->tell(said.text("address", edge->address).text("reason", failure.reason));
    }
    legs_.clear();
    run_->drop_pending();
    if (!failure.hazards && failure.lost.empty()) {
        run_->look();
    }
    if (!failure.hazards && endangered()) {
        return;
    }
    if (failure.hazards || !failure.lost.empty()) {
        hold(hold_lost(
            failure.lost, failure.reason, failure.hazards ? "hazard" : "guard_lost"));
        return;
    }
    if (!failure.pending && !run_->stands(run_->configuration)) {
        if (const auto alone = sub_alone(failure.edge->branch)) {
            adopt(*alone);
            return;
        }
    }
    if (const auto why = relocalise(failure.reason, terms_.adopts)) {
        hold(*why);
    }
}

bool Dispatcher::lost() {
    if (run_->lost_critical().empty()) {
        return false;
    }
    run_->look();
    const std::vector<std::string> facts = run_->lost_critical();
    if (!facts.empty()) {
        hold(hold_lost(facts, "", "guard_lost"));
    }
    return true;
}

bool Dispatcher::endangered() {
    const std::vector<Hazard> found = run_->met();
    if (found.empty()) {
        return false;
    }
    legs_.clear();
    run_->tell_hazards(found);
    hold(hold_lost(run_->met_words(found), "", "hazard"));
    return true;
}

Dispatcher::Hold Dispatcher::hold_lost(
    const std::vector<std::string>& facts, const std::string& cause, const std::string& kind) {
    Hold why{cause.empty() ? joined(facts, "; ") : cause, facts, kind};
    if (const auto found = relocalise("", false)) {
        for (const std::string& detail : found->details) {
            if (std::find(why.details.begin(), why.details.end(), detail) == why.details.end()) {
                why.details.push_back(detail);
            }
        }
    }
    return why;
}

std::optional<Dispatcher::Hold> Dispatcher::relocalise(const std::string& cause, bool adopts) {
    run_->drop_pending();
    run_->look();
    if (run_->stands(run_->configuration)) {
        const std::string here = run_->json_of(run_->configuration);
        run_->tell(run_->event("relocalised").raw("configuration", here));
        return std::nullopt;
    }
    const std::vector<Check> checks = run_->checks(run_->configuration);
    const std::vector<std::string> facts = run_->odd_words(checks);
    const std::vector<Configuration> found = candidates();
    std::string listed;
    for (const Configuration& one : found) {
        listed += (listed.empty() ? "" : ",") + run_->json_of(one);
    }
    Object said = run_->event("mismatch");
    said.raw("facts", json_list(facts));
    run_->tell(said.raw("candidates", "[" + listed + "]"));
    if (adopts && run_->met().empty() && found.size() == 1 && run_->stands(found.front())) {
        adopt(found.front());
        return std::nullopt;
    }
    const auto first = std::find_if(
        checks.begin(), checks.end(), [](const Check& check) { return !check.is_true(); });
    return Hold{cause.empty() ? run_->why_not(*first) : cause, facts};
}

void Dispatcher::adopt(const Configuration& configuration) {
    run_->configuration = configuration;
    legs_.clear();
    const std::string here = run_->json_of(configuration);
    run_->tell(run_->event("relocalised").raw("configuration", here));
}

std::vector<int> Dispatcher::true_states(int branch, const Configuration& all) const {
    Configuration mine = all;
    mine[index(branch)] = run_->configuration[index(branch)];
    const std::vector<Check> every = run_->checks(mine);
    for (const Check& check : every) {
        if (check.branch == branch && check.is_true()) {
            return {mine[index(branch)]};
        }
    }
    return run_->fitting(branch, all);
}

// The consistent configurations made of states that fit: sub-SBs first, then the bases decide which
// of its states a sub-SB may be in.
std::vector<Configuration> Dispatcher::candidates() const {
    Configuration all = run_->configuration;
    std::map<int, std::vector<int>> found;
    for (auto one = hierarchy_.order.rbegin(); one != hierarchy_.order.rend(); ++one) {
        found[*one] = true_states(*one, all);
        if (found[*one].empty()) {
            return {};
        }
        all[index(*one)] = found[*one].front();
    }
    for (const int one : hierarchy_.order) {
        for (const auto& [base, digit] : hierarchy_.bases[index(one)]) {
            const bool on = hierarchy_.of(base).is_on(found[base].front(), digit);
            std::vector<int>& states = found[one];
            states.erase(
                std::remove_if(
                    states.begin(), states.end(),
                    [&, this](int state) { return hierarchy_.is_active(one, state) != on; }),
                states.end());
        }
        if (found[one].empty()) {
            return {};
        }
    }
    std::vector<Configuration> every{run_->configuration};
    for (const int one : hierarchy_.order) {
        std::vector<Configuration> more;
        for (const Configuration& known : every) {
            for (const int state : found[one]) {
                more.push_back(known);
                more.back()[index(one)] = state;
                if (more.size() == most_named) {
                    break;
                }
            }
            if (more.size() == most_named) {
                break;
            }
        }
        every = more;
    }
    std::vector<Configuration> standing;
    std::copy_if(
        every.begin(), every.end(), std::back_inserter(standing),
        [this](const Configuration& one) { return run_->stands(one); });
    return standing;
}

std::optional<Configuration> Dispatcher::sub_alone(int branch) const {
    const std::vector<int> states = true_states(branch, run_->configuration);
    if (hierarchy_.bases[index(branch)].empty() || states.size() != 1) {
        return std::nullopt;
    }
    Configuration moved = run_->configuration;
    moved[index(branch)] = states.front();
    if (!hierarchy_.disagreements(moved).empty() || !run_->stands(moved)) {
        return std::nullopt;
    }
    return moved;
}

// waiting and ending --------------------------------------------------------------------------------

std::vector<std::string> Dispatcher::risky_way() {
    std::vector<std::string> found;
    if (!risky_.empty()) {
        bool gave_up = false;
        Planner planner(hierarchy_, edges_, shut_);
        for (const Leg& leg :
             planner.legs(run_->configuration, goals_, gave_up).value_or(Legs{})) {
            for (const std::string& edge : leg.operations()) {
                if (risky_.count(edge) &&
                    std::find(found.begin(), found.end(), edge) == found.end()) {
                    found.push_back(edge);
                }
            }
        }
    }
    return found;
}

Dispatcher::Hold Dispatcher::no_way() {
    std::string goal;
    for (const Goal& one : goals_) {
        if (goal.empty() && run_->configuration[index(one.first)] != one.second) {
            goal = goal_text(one);
        }
    }
    const std::vector<std::string> risky = risky_way();
    if (!risky.empty()) {
        std::vector<std::string> details;
        for (const std::string& edge : risky) {
            details.push_back(edge + ": " + risky_[edge]);
        }
        return Hold{
            "Only risky operations lead to " + goal + ": " + joined(risky, ", ") + ".", details};
    }
    std::vector<std::string> here;
    std::vector<std::string> details;
    for (const int one : hierarchy_.order) {
        const int state = run_->configuration[index(one)];
        const Branch& branch = hierarchy_.of(one);
        here.push_back(branch.name + "/" + branch.states[index(state)].name);
        for (const Edge& edge : edges_.out(one, state)) {
            if (!planner_) {
                planner_ = std::make_unique<Planner>(hierarchy_, edges_, closed());
            }
            const StepAnswer answer = planner_->stepper.step(run_->configuration, edge);
            const auto* no = std::get_if<Unavailable>(&answer);
            details.push_back(
                edge.address + ": " +
                (no ? joined(no->reasons, "; ") : "possible, but no way leads on from there"));
        }
    }
    return Hold{
        "Nothing permitted leads from " + joined(here, ", ") + " to " + goal + ".", details,
        "no_route"};
}

void Dispatcher::hold(const Hold& why) {
    since_.reset();
    Object said = run_->event("held");
    said.text("reason", why.reason).raw("details", json_list(why.details));
    run_->tell(said.text("kind", why.kind));
    finish(why.kind == "no_route" ? "no_route" : "held", why.reason);
}

// Nothing begins in a world that is gone.
void Dispatcher::lose() {
    const std::string why = world_.lost();
    if (carrier_) {
        carrier_->cut(why);
    }
    Object said = run_->event("held");
    run_->tell(said.text("reason", why).raw("details", "[]").text("kind", "held"));
    finish("failed", why);
}

void Dispatcher::stop_now() {
    const std::string by = "a person";
    Object said = run_->event("commanded");
    said.text("command", "stop").text("by", by).text("address", "").text("value", "");
    run_->tell(said.text("reason", "").text("refused", ""));
    if (carrier_) {
        carrier_->cut("stopped by " + by);
    } else {
        world_.brake();
    }
    run_->drop_pending();
    run_->tell(run_->event("stopped").text("by", by));
    finish("stopped", "Stopped by " + by + "." + (run_->gone() ? " " + world_.lost() + "." : ""));
}

void Dispatcher::finish(const std::string& reason, const std::string& sentence) {
    if (finished()) {
        return;
    }
    reason_ = reason;
    carrier_.reset();
    Object said = run_->event("run_finished");
    said.text("reason", reason).text("sentence", sentence).count("operations", run_->operations);
    run_->tell(said.raw("configuration", run_->json_of(run_->configuration)));
}

}  // namespace dsfo
