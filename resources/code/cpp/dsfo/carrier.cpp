#include "carrier.hpp"

#include <algorithm>

#include "needed.hpp"

namespace dsfo {

namespace {

constexpr double hair = 1e-9;
const char* const unsure = "the operation was cancelled and may have changed it";

bool has(const std::vector<const Edge*>& edges, const Edge* edge) {
    return std::find(edges.begin(), edges.end(), edge) != edges.end();
}

}  // namespace

Carrier::Carrier(LiveRun& run, StepPointer its_step) : step(std::move(its_step)), run_(run) {}

const Action& Carrier::action() const {
    return step->actions[std::min(at_, step->actions.size() - 1)];
}

bool Carrier::moving() const {
    return stage == Stage::running || stage == Stage::asking || stage == Stage::settling;
}

bool Carrier::can_freeze() const {
    const Operation& terms = *edge().terms;
    const bool resumes = terms.resumes || run_.levels.by_person(edge());
    return stage == Stage::asking || stage == Stage::settling ||
           (terms.stop == "hold" && resumes);
}

std::set<std::string> Carrier::uncommitted() const {
    std::set<std::string> found;
    for (const Edge* edge : step->edges) {
        found.insert(edge->address);
    }
    for (std::size_t at = 0; at < at_; ++at) {
        for (const Edge* edge : step->actions[at].commits) {
            found.erase(edge->address);
        }
    }
    return found;
}

std::set<Fact> Carrier::touched() const {
    const std::size_t count = std::min(at_ + (stage == Stage::next ? 0 : 1), step->actions.size());
    const std::vector<Action> begun(
        step->actions.begin(), step->actions.begin() + static_cast<long>(count));
    return run_.touched(begun, uncommitted());
}

// what the step needs -------------------------------------------------------------------------------

std::vector<std::string> Carrier::lost_facts() const {
    std::vector<std::string> found;
    const auto add = [&found](const std::vector<std::string>& reasons) {
        for (const std::string& reason : reasons) {
            if (std::find(found.begin(), found.end(), reason) == found.end()) {
                found.push_back(reason);
            }
        }
    };
    std::set<Fact> left_out = changing_;
    for (const Question& one : wants) {
        if (one.fact) {
            left_out.insert(*one.fact);
        }
    }
    for (const Edge* edge : required_) {
        Edge rest = *edge;
        rest.needs.erase(
            std::remove_if(
                rest.needs.begin(), rest.needs.end(),
                [this](const Requirement& need) { return changed_.count(need.fact) > 0; }),
            rest.needs.end());
        add(run_.unmet(rest, left_out));
    }
    add(run_.lost_critical(left_out));
    return found;
}

bool Carrier::notice() {
    std::vector<Hazard> fresh;
    for (const Hazard& hazard : run_.met()) {
        if (run_.told_hazards.count(hazard.name) == 0) {
            fresh.push_back(hazard);
        }
    }
    if (!fresh.empty()) {
        run_.tell_hazards(fresh);
        hazards_ = true;
        const std::vector<std::string> words = run_.met_words(fresh);
        lost_.insert(lost_.end(), words.begin(), words.end());
    }
    if (!lost_.empty()) {
        return !fresh.empty();
    }
    lost_ = lost_facts();
    return !lost_.empty();
}

std::string Carrier::lost_words() const {
    return lost_.empty() ? "" : edge().address + " cannot go on: " + joined(lost_, "; ");
}

void Carrier::watch() {
    if (!moving() || !notice()) {
        return;
    }
    const bool own = stage == Stage::running || person_acts();
    if (stage == Stage::settling || (own && edge().terms->stop == "finish")) {
        return;
    }
    if (stage == Stage::running) {
        cancel("cancelled", lost_words());
    } else {
        end_asking(lost_words());
    }
    settle();
}

// ticks ---------------------------------------------------------------------------------------------

void Carrier::advance(const Shut& shut) {
    if (stage == Stage::running) {
        go_on();
    } else if (stage == Stage::next) {
        begin(shut);
    } else if (stage == Stage::settling) {
        run_.pass_tick();
        if (run_.gone()) {
            return;
        }
        notice();
        if (hazards_ || run_.time() >= until_ - hair) {
            decide();
        }
    }
}

std::string Carrier::barred(const Shut& shut) const {
    const std::set<std::string> open = uncommitted();
    for (const Edge* edge : step->edges) {
        const auto found = shut.find(edge->address);
        if (found != shut.end() && open.count(edge->address)) {
            return edge->address + " is " + found->second;
        }
    }
    return "";
}

// Why the next function may not run after all; empty if it may.
std::string Carrier::refusal() {
    const Action& now = action();
    if (!notice()) {
        for (const Edge* edge : now.begins) {
            if (!edge->needs.empty()) {
                required_.push_back(edge);
            }
        }
        lost_ = lost_facts();
        changing_ = run_.changed_by(now);
        changing_.insert(now.transit.begin(), now.transit.end());
        changed_.insert(changing_.begin(), changing_.end());
    }
    const std::string lost = lost_words();
    if (!lost.empty() || at_ == 0) {  // before the first action all guards have agreed just now
        return lost;
    }
    const Configuration all = run_.believed();
    const int branch = now.edge->branch;
    const Check source = run_.check(branch, all[static_cast<std::size_t>(branch)], run_.transit);
    if (!source.is_true()) {
        return run_.why_not(source);
    }
    const auto found = run_.objection(now.edge->address, {now});
    hazards_ = hazards_ || found;
    return found ? found->sentence : "";
}

void Carrier::begin(const Shut& shut) {
    const Action& now = action();
    std::string no = barred(shut);
    no = no.empty() ? refusal() : no;
    if (!no.empty()) {
        fail(no, false, !run_.transit.empty());
        return;
    }
    run_.transit = now.transit;
    run_.moving = now.moved;
    for (const Edge* edge : now.begins) {
        const Branch& own = run_.hierarchy.of(edge->branch);
        const bool runs = edge->acts && !run_.levels.by_person(*edge);
        Object said = run_.event("operation_started");
        said.text("address", edge->address);
        said.text("target", own.states[static_cast<std::size_t>(edge->target)].name);
        run_.tell(said.text("function", runs ? edge->terms->function : ""));
    }
    run_.forget(run_.changed_by(now));
    since_ = run_.time();
    answerable_ = true;
    by_.clear();
    if (run_.levels.by_person(*now.edge)) {
        want({operation_task(*now.edge)});
    } else {
        start_function();
    }
}

void Carrier::start_function() {
    calls_ = 0;
    stage = Stage::running;
}

void Carrier::go_on() {
    const Edge& own = edge();
    Outcome outcome = Outcome::raised;
    try {
        outcome = own.terms->run(run_.world, own, calls_++);
    } catch (...) {  // code of others may throw anything
        outcome = Outcome::raised;
    }
    run_.pass_tick();
    if (run_.gone()) {
        return;
    }
    if (outcome == Outcome::running) {
        watch();
        if (stage == Stage::running && run_.time() - since_ >= own.terms->timeout - hair) {
            fault_ = own.address + " took longer than its " +
                     plain_number(own.terms->timeout) + " s";
            cancel("timed_out", fault_);
            settle();
        }
        return;
    }
    const std::string says = own.terms->function + " says that it failed";
    if (outcome == Outcome::failed) {
        ended("failed", says);
        fault_ = own.address + " failed: " + says;
    } else if (outcome == Outcome::raised) {
        ended("raised", "it threw an exception");
        fault_ = own.address + " raised an error: it threw an exception";
    } else {
        ended("returned", by_);
    }
    notice();
    settle();
}

// outcome (clause 7) --------------------------------------------------------------------------------

void Carrier::settle() {
    stage = Stage::settling;
    until_ = run_.time() + run_.world.settle();
    if (run_.world.settle() <= 0.0 || hazards_) {
        decide();
    }
}

void Carrier::decide() {
    const Action& now = action();
    run_.look();
    notice();
    if (!fault_.empty()) {
        fail(fault_, blame_);
        return;
    }
    if (!lost_.empty()) {
        fail(lost_words(), false);
        return;
    }
    run_.pending.put_all(now.moved);
    run_.transit = now.after;
    run_.moving = {};
    std::vector<Check> checks;
    for (const auto& [branch, state] : now.targets().all) {
        checks.push_back(run_.check(branch, state, now.after));
    }
    const bool possible = std::all_of(
        checks.begin(), checks.end(), [](const Check& one) { return one.truth().value_or(true); });
    const std::vector<Question> asked =
        answerable_ && possible ? needed_in(run_, checks) : std::vector<Question>{};
    if (!asked.empty()) {
        answerable_ = false;
        want(asked);
        return;
    }
    for (const Check& check : checks) {
        run_.tell_check(check);
        if (!check.is_true()) {
            fail(run_.why_not(check), true);
            return;
        }
    }
    succeed();
}

void Carrier::succeed() {
    const Action& now = action();
    if (!now.commits.empty()) {
        run_.commit(now);
    }
    changing_.clear();
    required_.erase(
        std::remove_if(
            required_.begin(), required_.end(),
            [&now](const Edge* edge) { return has(now.commits, edge); }),
        required_.end());
    if (++at_ == step->actions.size()) {
        stage = Stage::done;
        return;
    }
    stage = Stage::next;
    const std::vector<Term> broken = run_.broken();
    if (!broken.empty()) {
        fail(joined(run_.words(broken), "; "), false, !run_.transit.empty());
    }
}

// The step counts as pending from the start of a crossing until its commit.
void Carrier::fail(const std::string& reason, bool risky) {
    fail(reason, risky, !action().transit.empty());
}

void Carrier::fail(const std::string& reason, bool risky, bool pending) {
    failure = Failure{&edge(), reason, risky, pending, unanswered_, lost_, hazards_};
    stage = Stage::failed;
}

// people --------------------------------------------------------------------------------------------

void Carrier::want(const std::vector<Question>& questions) {
    wants = questions;
    stage = Stage::asking;
}

void Carrier::answered(const Tasks& closed) {
    const std::string kind = wants.front().kind;
    const std::string no = no_words(closed);
    wants.clear();
    if (kind == "operation") {
        person_ended(*closed.front(), no);
    } else if (!no.empty()) {
        unanswered_ = true;
        fail(no, false);
    } else {
        decide();
    }
}

void Carrier::unanswered(const std::string& reason) {
    const std::string kind = wants.front().kind;
    wants.clear();
    if (kind == "operation") {
        ended("cancelled", reason);
    }
    unanswered_ = true;
    fail(reason, false);
}

// The end of a person's action. Only a failure is believed at once.
void Carrier::person_ended(const Task& task, const std::string& no) {
    if (task.yes()) {
        by_ = "done by " + task.who();
        if (dynamic_cast<const TableWorld*>(&run_.world) != nullptr) {
            // nobody can touch a table, so the function writes down what the person has done
            start_function();
            return;
        }
        ended("returned", by_);
    } else {
        const bool told = task.outcome == "answered";
        ended(told ? "failed" : "timed_out", no);
        fault_ = no;
        blame_ = told;
        unanswered_ = !told;
    }
    settle();
}

// ends ----------------------------------------------------------------------------------------------

void Carrier::abort(const std::string& reason) {
    if (stage == Stage::running) {
        cancel("cancelled", reason);
    } else if (stage == Stage::asking) {
        end_asking(reason);
    } else if (stage == Stage::next) {
        fail(reason, false, !run_.transit.empty());
        return;
    } else {
        return;
    }
    fault_ = reason;
    blame_ = false;
    settle();
}

std::set<Fact> Carrier::cut(const std::string& reason) {
    const std::set<Fact> found = touched();
    if (stage == Stage::running) {
        cancel("cancelled", reason);
    } else if (stage == Stage::asking) {
        end_asking(reason);
    }
    stage = Stage::failed;
    return found;
}

// Withdraws the questions. A person who was acting is taken to have stopped.
void Carrier::end_asking(const std::string& reason) {
    if (person_acts()) {
        ended("cancelled", reason);
        run_.doubt(touched(), unsure);
    }
    wants.clear();
}

// What the function may have changed is unknown until it is sensed again.
void Carrier::cancel(const std::string& outcome, const std::string& message) {
    run_.world.brake();
    ended(outcome, message);
    run_.doubt(touched(), unsure);
}

void Carrier::ended(const std::string& outcome, const std::string& message) {
    Object said = run_.event("operation_ended");
    said.text("address", edge().address).text("outcome", outcome);
    run_.tell(said.text("message", message));
}

}  // namespace dsfo
