#include "driver.hpp"

#include <algorithm>

#include "needed.hpp"

namespace dsfo {

namespace {

std::size_t index(int number) { return static_cast<std::size_t>(number); }

}  // namespace

Driver::Driver(LiveRun& live, Course& its_course, Supervisor* supervisor, Conduct its_conduct)
    : run(live),
      course(its_course),
      conduct(its_conduct),
      reviewer(supervisor),
      attended(its_conduct.attended),
      trouble(live, its_course, its_conduct.adopts),
      desk(live, attended) {}

// the start (clauses 1, 3 and 11) -------------------------------------------------------------------

// People tell the facts that only they know, then the state checks follow.
void Driver::start() {
    if (told) {
        accepted();
        return;
    }
    std::vector<std::string> before;
    std::swap(before, run.events);
    run.look();
    std::vector<std::string> changes;
    std::swap(changes, run.events);
    std::swap(before, run.events);
    const std::vector<Question> facts = needed_in(run, run.checks(run.configuration));
    if (facts.empty()) {
        tell_start(changes);
        return;
    }
    run.events.insert(run.events.end(), changes.begin(), changes.end());
    const std::string nobody = desk.ask(facts, [this](const Tasks& closed) {
        const std::string no = no_words(closed);
        if (no.empty()) {
            tell_start({});
        } else {
            refuse(no, "The start must be known before anything moves.");
        }
    });
    if (!nobody.empty()) {
        refuse(
            nobody,
            "Run it where somebody answers, or by a script that does, or let sensors say what it "
            "asks.");
    }
}

void Driver::refuse(const std::string& words, const std::string& advice) {
    finish("refused", words + ". " + advice);
}

void Driver::tell_start(const std::vector<std::string>& changes) {
    const std::vector<Check> checks = run.checks(run.configuration);
    std::vector<std::string> wrong;
    for (const Check& check : checks) {
        if (!check.is_true() && wrong.size() < 20) {
            wrong.push_back(run.why_not(check));
        }
    }
    if (!wrong.empty()) {
        refuse(joined(wrong, "; "), "Put the world where the start has it.");
        return;
    }
    const std::vector<Hazard> met = run.met();
    if (!met.empty()) {
        refuse(
            "the start meets a hazard: " + joined(run.met_words(met), "; "),
            "Start where its facts do not hold together.");
        return;
    }
    tell_started(changes, checks);
    told = true;
    accepted();
}

void Driver::tell_started(
    const std::vector<std::string>& changes, const std::vector<Check>& checks) {
    std::vector<std::string> goals;
    for (const Goal& goal : course.goals) {
        goals.push_back(goal_text(run.hierarchy, goal));
    }
    std::map<std::pair<std::string, int>, std::string> sensed;  // in the order of their names
    for (const Fact& fact : run.blueprint.sensed()) {
        sensed[{run.hierarchy.of(fact.first).name, fact.second}] = run.blueprint.fact_text(fact);
    }
    std::vector<std::string> names;
    for (const auto& one : sensed) {
        names.push_back(one.second);
    }
    Object said = run.event("run_started");
    said.text("world", run.world.name()).count("seed", conduct.seed);
    said.raw("start", run.json_of(run.configuration)).raw("goals", json_list(goals));
    said.text("behaviour", run.blueprint.behaviour);
    run.tell(said.raw("sensed", json_list(names)));
    for (const auto& [at, words] : run.blueprint.left_out) {
        run.tell(run.event("left_out").text("address", at).text("sentence", words));
    }
    run.events.insert(run.events.end(), changes.begin(), changes.end());
    for (const Check& check : checks) {
        run.tell_check(check);
    }
}

// Asks whether what inspection found is accepted, if a person must say so.
void Driver::accepted() {
    const std::string found = findings();
    if (found.empty()) {
        over = true;
        return;
    }
    const std::string nobody = desk.ask({start_task()}, [this](const Tasks& closed) {
        const Task& task = *closed.front();
        if (task.yes()) {
            over = true;
        } else if (task.answer() != nullptr) {
            finish("refused", "The findings were not accepted: " + task.why() + ".");
        } else {
            hold(Hold{task.why(), {findings()}, "held", {}});
        }
    });
    if (!nobody.empty()) {
        hold(Hold{nobody, {found}, "held", {}});
    }
}

std::string Driver::findings() const {
    const std::string& level = run.levels.inspection;
    if (level == "automatic" || over) {
        return "";
    }
    const std::string& found = run.blueprint.findings;
    return found.empty() && level == "human" ? "Inspection found nothing." : found;
}

// one tick ------------------------------------------------------------------------------------------

void Driver::go_on() {
    const bool asking = desk.busy();
    if (carrier && !(asking || state.frozen)) {
        carry();  // in every run state: what has begun goes on
        return;
    }
    const std::string now = phase();
    if (now == "paused") {
        return;
    }
    if (asking && !outlived()) {
        wait(now == "waiting");
    } else if (carrier) {
        carry();
    } else if (!over && (now == "running" || now == "ready")) {
        start();
    } else if (now == "running") {
        propose();
    } else {
        live(now == "ready");
    }
}

// Until people have answered, time passes in the world.
void Driver::wait(bool watched) {
    if (desk.settled()) {
        return;
    }
    if (!carrier) {
        live(watched);
    } else {
        run.pass_tick();
        if (run.gone()) {
            return;
        }
        carrier->watch();
        if (carrier->stage != Carrier::Stage::asking) {
            desk.withdraw();
            after_step();
            return;
        }
    }
    if (!run.gone()) {
        desk.pass_time();
        desk.settled();
    }
}

// Whether people are asked about a step that has ended meanwhile.
bool Driver::outlived() {
    if (!carrier || carrier->stage == Carrier::Stage::asking) {
        return false;
    }
    desk.withdraw();
    return true;
}

// Time passes while a person thinks. If `watched`, integrity is checked (clause 9).
void Driver::live(bool watched) {
    arrival.begin();
    run.pass_tick();
    if (run.gone() || endangered() || !watched || (told && lost()) || desk.keeps()) {
        return;
    }
    if (arrival.moved && !desk.busy() && arrival.open()) {
        arrival.look();
        return;
    }
    if (run.broken().empty()) {
        broken_since_.reset();
        return;
    }
    broken_since_ = broken_since_.value_or(run.time());
    if (run.time() - *broken_since_ >= run.world.settle()) {
        withdraw();
        hold(trouble.relocalise());
    }
}

void Driver::propose() {
    if ((told && lost()) || endangered()) {
        return;
    }
    if (arrival.closing || arrival.open()) {
        arrival.begin();
        run.pass_tick();
        if (!run.gone()) {
            arrival.look();
        }
        return;
    }
    if (const StepPointer step = next_step()) {
        admission.admit(step);
    }
}

// The next step of the route; without one the run holds.
StepPointer Driver::next_step() {
    const Next next = course.next_step(run.configuration);
    if (!next.step) {
        hold(next.gave_up ? Hold{"Planning was given up: the search takes too much.", {}, "held", {}}
                          : trouble.no_way());
        return nullptr;
    }
    if (next.leg != nullptr) {
        Object said = run.event("route_planned");
        said.text("goal", next.leg->aim(run.hierarchy));
        said.raw("operations", json_list(next.leg->operations()));
        run.tell(said.number("cost", next.leg->cost()));
        std::vector<const Edge*> ahead = next.step->edges;
        const std::vector<const Edge*> more = course.ahead();
        ahead.insert(ahead.end(), more.begin(), more.end());
        tell_bypasses(ahead);
    }
    return next.step;
}

// Edges that set the facts of their sub-SBs by themselves are told before they are taken.
void Driver::tell_bypasses(const std::vector<const Edge*>& edges, bool again) {
    std::set<std::string> now;
    for (const Edge* edge : edges) {
        const bool fresh = now.insert(edge->address).second;
        if (!edge->load || !fresh || (bypassed_.count(edge->address) && !again)) {
            continue;
        }
        bypassed_.insert(edge->address);
        std::vector<std::string> subs;
        std::vector<std::string> facts;
        const Branch& own = run.hierarchy.of(edge->branch);
        for (const auto& [digit, sub] : run.hierarchy.subs[index(edge->branch)]) {
            if (std::count(edge->falls.begin(), edge->falls.end(), digit) +
                    std::count(edge->rises.begin(), edge->rises.end(), digit) ==
                0) {
                continue;
            }
            facts.push_back(own.fact_name(digit));
            for (const int below : run.hierarchy.tree(sub)) {
                const std::string& name = run.hierarchy.of(below).name;
                if (std::find(subs.begin(), subs.end(), name) == subs.end()) {
                    subs.push_back(name);
                }
            }
        }
        Object said = run.event("subs_bypassed");
        said.text("address", edge->address).raw("subs", json_list(subs));
        run.tell(said.text(
            "sentence", "Goes by " + title_of(*edge) + ": it sets " + joined(facts, " and ") +
                            " of " + own.name + " by itself, and no operation of " +
                            joined(subs, " and ") + " is carried out."));
    }
}

// one step ------------------------------------------------------------------------------------------

void Driver::begin(const StepPointer& step, bool by_person) {
    if (by_person) {
        course.drop_plan();
        loops.forget();
        reviewer.forget();
        tell_bypasses(step->edges, true);
    } else {
        loops.count(run, *step->asked);
    }
    state.begin(by_person);
    release();
    desk.withdraw();
    carrier = std::make_unique<Carrier>(run, step);
    carry();
}

void Driver::carry() {
    if (carrier->stage != Carrier::Stage::failed) {
        carrier->advance(course.shut);
        if (run.gone()) {
            return;
        }
    }
    after_step();
}

// Handles the new stage of a step, after a tick or an answer.
void Driver::after_step() {
    if (carrier->stage == Carrier::Stage::asking) {
        const std::string nobody = desk.ask(carrier->wants, [this](const Tasks& closed) {
            carrier->answered(closed);
            after_step();
        });
        if (!nobody.empty()) {
            carrier->unanswered(nobody);
        }
    }
    const bool moving = carrier->moving();
    if (carrier->stage == Carrier::Stage::failed) {
        const std::unique_ptr<Carrier> ended = std::move(carrier);
        failed(*ended->step, ended->failure);
    } else if (carrier->stage == Carrier::Stage::done) {
        carrier.reset();
        if (!endangered() && !run.broken().empty()) {
            hold(trouble.relocalise());
        }
    }
    if (this->ended()) {
        return;
    }
    if (state.pausing && !moving) {
        now_paused();
    }
    if (!carrier) {
        arrival.begin(true);
        if (state.once && (state.by_hand || !arrival.open())) {
            state.once = false;
            if (!state.by_hand) {
                now_paused();
            }
        }
    }
}

// Finds out where the run stands, after people have told the facts that only they know.
void Driver::failed(const JointStep& step, const Failure& failure) {
    const auto relocalise = [this, failure] {
        if (!failure.hazards && endangered()) {
            return;
        }
        const std::optional<Hold> found = trouble.after(failure);
        if (found || failure.unanswered) {
            hold(found ? *found : Hold{failure.reason, {}, "held", {}});
        }
    };
    trouble.blame(step, failure);
    if (failure.unanswered || !failure.lost.empty() || failure.hazards) {
        relocalise();
    } else {
        informed(relocalise);
    }
}

// integrity (clause 9) ------------------------------------------------------------------------------

void Driver::informed(const std::function<void()>& then) {
    run.look();
    const std::vector<Question> facts = needed_in(run, run.checks(run.configuration));
    const auto call = [then](const Tasks&) { then(); };
    if (facts.empty() || !desk.ask(facts, call, true).empty()) {
        then();
    }
}

bool Driver::lost() {
    if (endangered()) {
        return true;
    }
    const std::vector<Term> terms = run.lost_terms();
    if (terms.empty()) {
        return false;
    }
    const bool theirs = all_theirs(run, terms);
    if (theirs && desk.keeps()) {
        return false;
    }
    withdraw();
    const auto hold_lost = [this] {
        const std::vector<std::string> facts = run.lost_critical();
        if (!facts.empty()) {
            hold(trouble.lost(facts, "", "guard_lost"));
        }
    };
    if (theirs) {
        informed(hold_lost);
    } else {
        run.look();
        hold_lost();
    }
    return true;
}

// A run that holds is told again only of another hazard.
bool Driver::endangered() {
    std::vector<Hazard> found = told ? run.met() : std::vector<Hazard>{};
    if (found.empty()) {
        return false;
    }
    if (!state.stopped.empty() || state.held) {
        found.erase(
            std::remove_if(
                found.begin(), found.end(),
                [this](const Hazard& one) { return run.told_hazards.count(one.name) > 0; }),
            found.end());
        if (found.empty()) {
            return true;
        }
    }
    withdraw();
    run.tell_hazards(found);
    if (state.stopped.empty()) {
        hold(trouble.endangered(found, !state.taken_over.empty()));
    }
    return true;
}

// The scene decides before a run goes on.
void Driver::recheck() {
    if (carrier) {
        recheck_others();
    } else if (desk.busy()) {
        run.look();
    } else if (state.held) {
        loops.forget();
        course.lift_vetoes(state.held->skipped);
        release();
        informed([this] { locate(); });
    } else {
        run.look();
        if (!endangered() && !run.stands(run.configuration)) {
            informed([this] {
                if (!endangered() && !run.stands(run.configuration)) {
                    hold(trouble.relocalise());
                }
            });
        }
    }
}

void Driver::locate() {
    if (!endangered()) {
        hold(trouble.relocalise());
    }
}

// Aborts a frozen operation if a fact that it does not move has changed.
void Driver::recheck_others() {
    run.look();
    carrier->watch();
    std::set<int> moved;
    for (const Edge* edge : carrier->step->edges) {
        const std::set<int> its = run.moved_by(*edge);
        moved.insert(its.begin(), its.end());
    }
    std::vector<Term> others;
    for (const Term& term : run.broken()) {
        if (!moved.count(term.fact.first)) {
            others.push_back(term);
        }
    }
    if (!others.empty()) {
        carrier->abort("while it was held, " + joined(run.words(others), "; "));
    }
}

// waiting and ending --------------------------------------------------------------------------------

// Nothing moves, and simulated time stands still.
void Driver::now_paused() {
    state.pause(carrier != nullptr || desk.busy());
    run.tell(run.event("paused"));
}

// Without attendance a pause is a hold.
void Driver::paused_or_held(const std::string& why) {
    if (attended) {
        now_paused();
    } else {
        hold(Hold{why, {}, "held", {}});
    }
}

// Goals were told: a single step ends, and if all goals hold the run ends.
void Driver::arrived(bool fresh, bool by_move, const std::string& words) {
    if (fresh) {
        loops.forget();
        repeats.forget();
    }
    if (state.by_hand) {
        state.once = false;
    } else if (by_move && state.once) {
        state.once = false;
        now_paused();
    } else if (!words.empty()) {
        finish("goal_reached", words);
    }
}

void Driver::withdraw() {
    course.drop_plan();
    reviewer.forget();
    if (!carrier && !desk.keeps()) {
        desk.withdraw();
    }
}

// Nothing moves until somebody decides. Without attendance the run ends.
void Driver::hold(const std::optional<Hold>& why) {
    if (!why) {
        return;
    }
    desk.withdraw();
    arrival.forget();
    state.hold(*why);
    sentence = why->reason;
    Object said = run.event("held");
    said.text("reason", why->reason).raw("details", json_list(why->details));
    run.tell(said.text("kind", why->kind));
    if (!attended) {
        finish(why->ends(), why->reason);
    }
}

void Driver::release() {
    state.held.reset();
    sentence.clear();
    broken_since_.reset();
    trouble.candidates.clear();
}

// The event with the reason is told at the end of the tick.
void Driver::finish(const std::string& why, const std::string& words) {
    desk.withdraw();
    carrier.reset();
    sentence = words;
    reason = why;
}

void Driver::tell_end() {
    Object said = run.event("run_finished");
    said.text("reason", reason).text("sentence", sentence).count("operations", run.operations);
    run.tell(said.raw("configuration", run.json_of(run.configuration)));
}

}  // namespace dsfo
