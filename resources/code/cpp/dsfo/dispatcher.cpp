#include "dispatcher.hpp"

namespace dsfo {

Dispatcher::Dispatcher(const Hierarchy& hierarchy, World& world, Terms terms)
    : hierarchy_(hierarchy),
      world_(world),
      terms_(std::move(terms)),
      levels_(hierarchy, terms_.levels) {
    if (terms_.supervisor == nullptr && levels_.supervision == "automatic") {
        terms_.supervisor = &limit_;
    }
}

std::vector<std::string> Dispatcher::drained() {
    std::vector<std::string> found;
    std::swap(found, run_->events);
    return found;
}

// the run -------------------------------------------------------------------------------------------

std::vector<std::string> Dispatcher::open() {
    begin();
    return drained();
}

// Checks the start and begins. A refusal ends in `run_finished`.
void Dispatcher::begin() {
    Configuration start;
    std::vector<Goal> goals;
    const std::string refused = refusal(start, goals);
    run_ = std::make_unique<LiveRun>(hierarchy_, world_, levels_, start, terms_.seed);
    if (!refused.empty()) {
        end_before(refused);
        return;
    }
    const std::vector<Hazard>& hazards = hierarchy_.blueprint.hazards;
    std::vector<Hazard> met;
    for (const Hazard& hazard : hazards) {
        if (hierarchy_.blueprint.meets(hazard, start)) {
            met.push_back(hazard);
        }
    }
    if (!met.empty()) {
        end_before("the start meets a hazard: " + joined(run_->met_words(met), "; "));
        return;
    }
    world_.begin(start);
    if (run_->gone()) {
        end_before(world_.lost());
        return;
    }
    course_ = std::make_unique<Course>(hierarchy_, goals, terms_.avoid);
    driver_ = std::make_unique<Driver>(
        *run_, *course_, terms_.supervisor,
        Conduct{terms_.seed, terms_.adopts, terms_.attended});
    driver_->desk.opened = terms_.asks;
    driver_->start();
    if (driver_->ended()) {
        reason_ = driver_->reason;
        driver_->tell_end();
    }
}

std::string Dispatcher::refusal(Configuration& start, std::vector<Goal>& goals) const {
    std::string refused;
    start = start_configuration(hierarchy_, terms_.start, refused);
    refused = terms_.refused.empty() ? refused : terms_.refused;
    if (refused.empty()) {
        goals = goals_of(hierarchy_, terms_.goals, refused);
    }
    return refused;
}

void Dispatcher::end_before(const std::string& sentence) {
    reason_ = "refused";
    Object said = run_->event("run_finished");
    said.text("reason", reason_).text("sentence", sentence + ".").count("operations", 0);
    run_->tell(said.raw("configuration", "{}"));
}

std::vector<std::string> Dispatcher::tick() {
    if (finished() || !driver_) {
        return {};
    }
    const bool set_going = obey();
    if (leaving_ && !driver_->ended()) {
        dsfo::leave(*driver_);
    }
    if (!driver_->ended() && !set_going && !run_->gone()) {
        driver_->go_on();
    }
    if (!driver_->ended() && run_->gone()) {
        lose();
    }
    if (driver_->ended()) {
        reason_ = driver_->reason;
        driver_->tell_end();
    }
    return drained();
}

// A command that has set an operation going ends this tick, so that other commands can come while the
// operation runs.
bool Dispatcher::obey() {
    if (waiting_.empty()) {
        return false;
    }
    const bool stood = !under_way();
    std::vector<Command> commands;
    std::swap(commands, waiting_);
    dsfo::obey(*driver_, commands);
    driver_->arrival.forget();
    return stood && under_way();
}

bool Dispatcher::under_way() const {
    return !driver_->ended() && !driver_->state.frozen && driver_->carrier &&
           driver_->carrier->stage == Carrier::Stage::running;
}

// Nothing begins in a world that is gone.
void Dispatcher::lose() {
    const std::string why = world_.lost();
    if (driver_->carrier) {
        driver_->carrier->cut(why);
    }
    driver_->desk.withdraw();
    Object said = run_->event("held");
    run_->tell(said.text("reason", why).raw("details", "[]").text("kind", "held"));
    driver_->finish("failed", why);
}

// commands ------------------------------------------------------------------------------------------

void Dispatcher::stop() {
    Command stop;
    stop.word = "stop";
    command(stop);
}

void Dispatcher::answer(
    const std::string& task, const std::string& option, const std::string& by,
    const std::string& role) {
    Command answer;
    answer.word = "answer";
    answer.by = by;
    answer.said = {
        {"task", json_of_text(task)},
        {"option", json_of_text(option)},
        {"role", json_of_text(role)}};
    command(answer);
}

std::vector<const Task*> Dispatcher::tasks() const {
    return driver_ ? driver_->desk.open() : std::vector<const Task*>{};
}

std::string Dispatcher::phase() const {
    return finished() ? "done" : driver_ ? driver_->phase() : "idle";
}

}  // namespace dsfo
