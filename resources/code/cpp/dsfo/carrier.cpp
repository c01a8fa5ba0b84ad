#include "carrier.hpp"

#include <algorithm>

namespace dsfo {

namespace {

constexpr double hair = 1e-9;

}  // namespace

Carrier::Carrier(LiveRun& run, StepPointer its_step) : step(std::move(its_step)), run_(run) {}

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

std::vector<std::string> Carrier::lost_facts() const {
    std::vector<std::string> found;
    const auto add = [&found](const std::vector<std::string>& reasons) {
        for (const std::string& reason : reasons) {
            if (std::find(found.begin(), found.end(), reason) == found.end()) {
                found.push_back(reason);
            }
        }
    };
    for (const Edge* edge : required_) {
        Edge rest = *edge;
        rest.needs.erase(
            std::remove_if(
                rest.needs.begin(), rest.needs.end(),
                [this](const Requirement& need) { return changed_.count(need.fact) > 0; }),
            rest.needs.end());
        add(run_.unmet(rest, changing_));
    }
    add(run_.lost_critical(changing_));
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
    return lost_.empty() ? "" : action().edge->address + " cannot go on: " + joined(lost_, "; ");
}

void Carrier::begin(const Shut& shut) {
    const Action& now = action();
    std::string no;
    for (const Edge* edge : step->edges) {
        const auto barred = shut.find(edge->address);
        if (no.empty() && barred != shut.end() && uncommitted().count(edge->address)) {
            no = edge->address + " is " + barred->second;
        }
    }
    if (no.empty()) {
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
        no = lost_words();
    }
    if (no.empty() && at_ > 0) {  // before the first action all guards have agreed just now
        const Configuration all = run_.believed();
        const int branch = now.edge->branch;
        const Check source =
            run_.check(branch, all[static_cast<std::size_t>(branch)], run_.transit);
        if (!source.is_true()) {
            no = run_.why_not(source);
        } else if (const auto found = run_.objection(now.edge->address, {now})) {
            hazards_ = true;
            no = found->sentence;
        }
    }
    if (!no.empty()) {
        fail(no, false, !run_.transit.empty());
        return;
    }
    run_.transit = now.transit;
    run_.moving = now.moved;
    for (const Edge* edge : now.begins) {
        const Branch& own = run_.hierarchy.of(edge->branch);
        Object said = run_.event("operation_started");
        said.text("address", edge->address);
        said.text("target", own.states[static_cast<std::size_t>(edge->target)].name);
        run_.tell(said.text("function", edge->acts ? edge->terms->function : ""));
    }
    since_ = run_.time();
    calls_ = 0;
    stage = Stage::running;
}

void Carrier::go_on() {
    const Edge& edge = *action().edge;
    Outcome outcome = Outcome::raised;
    try {
        outcome = edge.terms->run(run_.world, edge, calls_++);
    } catch (...) {  // code of others may throw anything
        outcome = Outcome::raised;
    }
    run_.pass_tick();
    if (run_.gone()) {
        return;
    }
    if (outcome == Outcome::running) {
        if (notice() && edge.terms->stop != "finish") {
            cancel("cancelled", lost_words());
            settle();
        } else if (run_.time() - since_ >= edge.terms->timeout - hair) {
            std::string limit = json_number(edge.terms->timeout);
            if (limit.size() > 2 && limit.substr(limit.size() - 2) == ".0") {
                limit.erase(limit.size() - 2);
            }
            fault_ = edge.address + " took longer than its " + limit + " s";
            cancel("timed_out", fault_);
            settle();
        }
        return;
    }
    const std::string says = edge.terms->function + " says that it failed";
    if (outcome == Outcome::failed) {
        ended("failed", says);
        fault_ = edge.address + " failed: " + says;
    } else if (outcome == Outcome::raised) {
        ended("raised", "it threw an exception");
        fault_ = edge.address + " raised an error: it threw an exception";
    } else {
        ended("returned", "");
    }
    notice();
    settle();
}

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
        fail(fault_, true, !now.transit.empty());
        return;
    }
    if (!lost_.empty()) {
        fail(lost_words(), false, !now.transit.empty());
        return;
    }
    run_.pending.put_all(now.moved);
    run_.transit = now.after;
    run_.moving = {};
    std::vector<Check> checks;
    for (const auto& [branch, state] : now.targets().all) {
        checks.push_back(run_.check(branch, state, now.after));
    }
    for (const Check& check : checks) {
        run_.tell_check(check);
        if (!check.is_true()) {
            fail(run_.why_not(check), true, !now.transit.empty());
            return;
        }
    }
    if (!now.commits.empty()) {
        run_.commit(now);
    }
    changing_.clear();
    required_.erase(
        std::remove_if(
            required_.begin(), required_.end(),
            [&now](const Edge* edge) {
                return std::find(now.commits.begin(), now.commits.end(), edge) !=
                       now.commits.end();
            }),
        required_.end());
    if (++at_ == step->actions.size()) {
        --at_;
        stage = Stage::done;
        return;
    }
    stage = Stage::next;
    const std::vector<Term> broken = run_.broken();
    if (!broken.empty()) {
        fail(joined(run_.words(broken), "; "), false, !run_.transit.empty());
    }
}

void Carrier::cut(const std::string& reason) {
    if (stage == Stage::running) {
        cancel("cancelled", reason);
    }
    stage = Stage::failed;
}

void Carrier::cancel(const std::string& outcome, const std::string& message) {
    run_.world.brake();
    ended(outcome, message);
    const auto end = step->actions.begin() + static_cast<long>(at_) + 1;
    const std::vector<Action> begun(step->actions.begin(), end);
    run_.doubt(
        run_.touched(begun, uncommitted()),
        "the operation was cancelled and may have changed it");
}

void Carrier::ended(const std::string& outcome, const std::string& message) {
    Object said = run_.event("operation_ended");
    said.text("address", action().edge->address).text("outcome", outcome);
    run_.tell(said.text("message", message));
}

void Carrier::fail(const std::string& reason, bool risky, bool pending) {
    failure = Failure{action().edge, reason, risky, pending, lost_, hazards_};
    stage = Stage::failed;
}

}  // namespace dsfo
