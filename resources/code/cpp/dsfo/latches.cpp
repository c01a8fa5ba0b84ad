#include "effects.hpp"
#include "needed.hpp"

namespace dsfo {

namespace {

std::string capital(const std::string& text) {
    std::string found = text;
    if (!found.empty() && found[0] >= 'a' && found[0] <= 'z') {
        found[0] = static_cast<char>(found[0] - 32);
    }
    return found;
}

// Ends everything that was going on or planned.
void end_all(Driver& driver) {
    driver.carrier.reset();
    driver.desk.withdraw();
    driver.reviewer.forget();
    driver.run.drop_pending();
    driver.course.drop_plan();
    driver.release();
}

// Brakes the world and ends what is carried out. The facts that it may have changed.
std::set<Fact> cut(Driver& driver, const std::string& reason) {
    std::set<Fact> touched;
    if (!driver.carrier || driver.carrier->stage != Carrier::Stage::running) {
        driver.run.world.brake();
    }
    if (driver.carrier) {
        touched = driver.carrier->cut(reason);
    }
    end_all(driver);
    return touched;
}

// Offers the configuration that fits the scene. Why there is none, or empty.
std::string offer(Driver& driver) {
    const std::vector<Configuration> found = driver.trouble.located();
    if (found.size() == 1) {
        driver.state.offered = found.front();
        return "";
    }
    std::vector<std::string> names;
    for (const Configuration& one : found) {
        names.push_back(states_text(driver.run, one));
    }
    if (!found.empty()) {
        return "the scene agrees with several configurations, " + joined(names, " or ") +
               "; make it one of them";
    }
    const std::vector<std::string> words =
        driver.run.odd_words(driver.run.checks(driver.run.configuration));
    return "the scene agrees with no configuration of the blueprint" +
           (words.empty() ? "" : ": " + joined(words, "; "));
}

bool at_goals(const Driver& driver) {
    return !driver.carrier && !driver.desk.busy() &&
           holds(driver.run.configuration, driver.course.goals);
}

void finish_waiting(Driver& driver, const std::string& sentence) {
    if (driver.carrier) {
        driver.carrier->cut("nobody is there to go on with it");
        driver.run.drop_pending();
    }
    driver.finish("held", sentence);
}

}  // namespace

namespace effects {

// If nobody attends the run, or its world is gone, the run ends.
std::string stop(Driver& driver, const Command& command) {
    const std::set<Fact> touched = cut(driver, "stopped by " + command.by);
    driver.state.latch(command.by, "");
    driver.state.touched = touched;
    const bool gone = driver.run.gone();
    driver.sentence = "Stopped by " + command.by + "." +
                      (gone ? " " + capital(driver.run.world.lost()) + "." : "");
    driver.run.tell(driver.run.event("stopped").text("by", command.by));
    if (gone || !driver.attended) {
        driver.finish("stopped", std::string(driver.sentence));
    }
    return "";
}

// What the stopped operation may have changed is unknown.
std::string reset(Driver& driver, const Command& command) {
    const std::set<Fact> touched = driver.state.touched;
    driver.state.touched.clear();
    driver.state.stopped.clear();
    driver.state.pause(false);
    driver.sentence.clear();
    std::vector<std::string> unknown;
    for (const Fact& fact : touched) {
        unknown.push_back(driver.run.blueprint.fact_text(fact));
    }
    Object said = driver.run.event("reset");
    driver.run.tell(said.text("by", command.by).raw("unknown", json_list(unknown)));
    driver.run.doubt(touched, "an operation that was stopped may have changed it");
    return "";
}

std::string end(Driver& driver, const Command&) {
    if (driver.state.held) {
        const Hold held = *driver.state.held;
        driver.finish(held.ends(), held.reason);
    } else {
        driver.finish("stopped", std::string(driver.sentence));
    }
    return "";
}

// The dispatcher only observes.
std::string take_over(Driver& driver, const Command& command) {
    cut(driver, command.by + " took over");
    driver.state.latch("", command.by);
    driver.sentence = capital(command.by) + " has taken over.";
    driver.run.tell(driver.run.event("taken_over").text("by", command.by));
    // the person may change anything, so earlier answers about the scene do not count any more
    const std::vector<Fact> all = driver.run.blueprint.sensed();
    driver.run.forget({all.begin(), all.end()});
    return "";
}

// If exactly one configuration fits the scene, it is offered.
std::string give_back(Driver& driver, const Command&) {
    driver.run.look();
    driver.state.offered.reset();
    const std::vector<Question> facts = needed_everywhere(driver.run);
    if (facts.empty()) {
        return offer(driver);
    }
    const auto told = [&driver](const Tasks&) {
        const std::string no = offer(driver);
        driver.sentence = no.empty() ? driver.sentence : no;
    };
    return driver.desk.ask(facts, told, true);
}

// The run is then paused.
std::string accept(Driver& driver, const Command& command) {
    if (!driver.state.offered) {
        return "nothing is offered: give it back first";
    }
    const Configuration offered = *driver.state.offered;
    driver.run.look();
    if (driver.trouble.located() != std::vector<Configuration>{offered}) {
        driver.state.offered.reset();
        return "the scene no longer agrees with " + states_text(driver.run, offered) +
               " alone: give it back again";
    }
    driver.state.latch();
    driver.state.paused = !driver.state.by_hand;
    driver.sentence.clear();
    driver.loops.forget();
    Object said = driver.run.event("given_back");
    said.text("by", command.by);
    driver.run.tell(said.raw("configuration", driver.run.json_of(offered)));
    driver.trouble.adopt(offered);
    driver.endangered();
    return "";
}

// For a run that holds.
std::string adopt(Driver& driver, const Command&) {
    const std::vector<Configuration> found = driver.trouble.candidates;
    if (found.size() != 1) {
        std::vector<std::string> names;
        for (const Configuration& one : found) {
            names.push_back(states_text(driver.run, one));
        }
        const std::string several = names.empty() ? "no configuration" : joined(names, " or ");
        return "the scene agrees with " + several + ", not with exactly one";
    }
    driver.run.look();
    if (!driver.run.stands(found.front())) {
        return "the scene no longer agrees with " + states_text(driver.run, found.front()) +
               ": resume reads it again";
    }
    driver.release();
    driver.loops.forget();
    driver.trouble.adopt(found.front());
    driver.endangered();
    return "";
}

}  // namespace effects

void leave(Driver& driver) {
    if (driver.phase() == "waiting") {
        driver.desk.settled();
    }
    driver.attended = false;
    const std::string phase = driver.phase();
    if (driver.state.held && (phase == "no_route" || phase == "fault_hold")) {
        const Hold held = *driver.state.held;
        driver.finish(held.ends(), held.reason);
    } else if (phase == "stopped") {
        driver.finish("stopped", std::string(driver.sentence));
    } else if ((phase == "ready" || phase == "paused") && at_goals(driver)) {
        driver.state.by_hand = false;
        driver.state.resume();
        driver.arrival.closing = true;
    } else if (phase == "waiting" && !driver.told) {
        const std::string nobody = driver.desk.nobody();
        driver.finish("refused", "The start is not known, and " + nobody + ".");
    } else if (phase == "waiting") {
        finish_waiting(driver, "The run is waiting, and " + driver.desk.nobody() + ".");
    } else if (phase == "ready" || phase == "paused" || phase == "taken_over") {
        const std::string words = phase == "ready"        ? "waiting to be asked"
                                  : phase == "taken_over" ? "taken over"
                                                          : phase;
        finish_waiting(
            driver, "The run is " + words + ", and nobody is there to go on with it.");
    }
}

}  // namespace dsfo
