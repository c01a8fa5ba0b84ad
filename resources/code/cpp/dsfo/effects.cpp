#include "effects.hpp"

#include <algorithm>

#include "faults.hpp"

namespace dsfo::effects {

namespace {

std::size_t index(int number) { return static_cast<std::size_t>(number); }

// What a person asks for, if its SB is in the state that it leaves.
StepAnswer asked(Driver& driver, const std::string& address) {
    const Edge* const edge = driver.course.edges().find(address);
    if (edge == nullptr) {
        return Unavailable{{"there is no operation " + address}, ""};
    }
    const Branch& own = driver.run.hierarchy.of(edge->branch);
    const int active = driver.run.configuration[index(edge->branch)];
    if (active != edge->source) {
        return Unavailable{
            {own.name + " is in " + own.states[index(active)].name + ", not in " +
             own.states[index(edge->source)].name},
            ""};
    }
    return driver.course.asked(driver.run.configuration, *edge);
}

std::string why_not_now(Driver& driver) {
    return driver.carrier      ? driver.carrier->step->asked->address + " is being carried out"
           : !driver.over      ? "the run has not begun yet"
           : driver.phase() == "running" && !driver.state.by_hand
               ? "the run is automatic, pause it first"
           : driver.desk.keeps() ? "people are being asked where the procedure stands"
                                 : "";
}

std::string told_parameters(const Command& command, const std::set<std::string>& left_out) {
    std::vector<std::pair<std::string, std::string>> found;
    for (const auto& [name, value] : command.said) {
        if (!left_out.count(name)) {
            found.emplace_back(
                name, value.kind == Json::Kind::number ? plain_number(value.number) : value.text);
        }
    }
    return json_map(found);
}

}  // namespace

// pace ----------------------------------------------------------------------------------------------

// `every_time` says that a script asks for it every time the run comes here, so the number is
// limited.
std::string ask(Driver& driver, const Command& command) {
    const std::string address = command.text("address");
    StepAnswer found = Unavailable{{why_not_now(driver)}, ""};
    if (std::get<Unavailable>(found).reasons.front().empty()) {
        driver.run.look();
        found = asked(driver, address);
        const auto* step = std::get_if<StepPointer>(&found);
        if (step != nullptr && command.flag("every_time")) {
            const std::string circling =
                driver.repeats.why_not(driver.run, *(*step)->asked);
            driver.repeats.count(driver.run, *(*step)->asked);
            if (!circling.empty()) {
                found = Unavailable{{circling}, ""};
            }
        }
    }
    if (const auto* step = std::get_if<StepPointer>(&found)) {
        const std::string refused = driver.admission.admit(*step, true);
        driver.state.frozen = driver.state.frozen && !refused.empty();
        return refused;
    }
    const Unavailable& no = std::get<Unavailable>(found);
    driver.admission.tell_refusal(address, no.reasons, no.hazard);
    return joined(no.reasons, "; ");
}

// Now, or as the running operation declares: after its end, or by aborting it.
std::string pause(Driver& driver, const Command&) {
    if (driver.state.pausing) {
        return "it pauses already, as soon as the operation allows";
    }
    Carrier* const carrier = driver.carrier.get();
    if (carrier == nullptr || !carrier->moving() || carrier->can_freeze()) {
        driver.now_paused();
        return "";
    }
    driver.state.pausing = true;
    if (carrier->edge().terms->stop != "finish") {
        carrier->abort("it was paused and cannot be held");
    }
    return "";
}

// A run by hand is automatic from now on.
std::string resume(Driver& driver, const Command&) {
    if (driver.phase() == "ready") {
        driver.state.by_hand = false;
    }
    driver.state.resume();
    driver.run.tell(driver.run.event("resumed"));
    if (!driver.carrier) {
        driver.course.drop_plan();
    }
    driver.reviewer.trust();
    driver.recheck();
    return "";
}

std::string step(Driver& driver, const Command&) {
    if (driver.phase() == "running" && driver.carrier) {
        return driver.carrier->step->asked->address +
               " is being carried out; step is ignored until it ended";
    }
    if (driver.state.once) {
        return "one operation is about to begin already";
    }
    driver.state.step();
    driver.reviewer.trust();
    driver.recheck();
    return "";
}

std::string set_automatic(Driver& driver, const Command& command) {
    driver.state.by_hand = !command.flag("automatic");
    const bool route_asks =
        driver.over && !driver.admission.chosen && !driver.desk.keeps();
    if (driver.state.by_hand && route_asks) {
        driver.withdraw();
    }
    return "";
}

// edges ---------------------------------------------------------------------------------------------

std::string next_edge(Driver& driver) {
    if (driver.carrier) {
        return "";
    }
    if (!driver.admission.proposed.empty() && driver.desk.busy() && !driver.desk.keeps()) {
        return driver.admission.proposed;
    }
    return driver.course.next_operation(driver.run.configuration);
}

// It is too late if the edge has begun.
std::string veto(Driver& driver, const Command& command) {
    const std::string address = command.text("address");
    Configuration here = driver.run.configuration;
    if (driver.carrier) {
        const JointStep& step = *driver.carrier->step;
        step.after.apply(here);
        const bool part = std::any_of(
            step.edges.begin(), step.edges.end(),
            [&address](const Edge* edge) { return edge->address == address; });
        if (address.empty() || part) {
            const std::string& whole = step.asked->address;
            const bool other = !address.empty() && address != whole;
            return "too late, " + whole + " is being carried out" +
                   (other ? ", and " + address + " is part of it" : "") + "; a stop ends it";
        }
    }
    if (address.empty()) {
        return "there is no next operation";
    }
    const Edge* const edge = driver.course.edges().find(address);
    if (edge == nullptr || edge->source != here[index(edge->branch)]) {
        return address + " is not next; a prune shuts it out until it is restored";
    }
    driver.course.veto(address, here);
    driver.withdraw();
    return "";
}

// If the edge is being carried out, it is aborted.
std::string prune(Driver& driver, const Command& command) {
    const std::string address = command.text("address");
    const std::string reason = command.text("reason");
    driver.course.prune(address, reason);
    Object said = driver.run.event("operation_pruned");
    driver.run.tell(said.text("address", address).text("reason", reason));
    if (driver.carrier && driver.carrier->uncommitted().count(address)) {
        driver.state.frozen = false;
        driver.carrier->abort(address + " was pruned: " + reason);
    }
    driver.withdraw();
    return "";
}

std::string restore(Driver& driver, const Command& command) {
    const std::string address = command.text("address");
    if (!driver.course.restore(address)) {
        return address + " is not shut out";
    }
    driver.run.tell(driver.run.event("operation_restored").text("address", address));
    return "";
}

// The route is planned again before the next operation.
std::string set_cost(Driver& driver, const Command& command) {
    const std::string address = command.text("address");
    const double cost = command.number("cost");
    if (driver.course.set_cost(address, cost)) {
        Object costs;
        costs.number(address, cost);
        Object said = driver.run.event("costs_changed");
        driver.run.tell(said.raw("costs", costs.str()).raw("faults", "[]"));
    }
    return "";
}

// people, view, trials ------------------------------------------------------------------------------

std::string answer(Driver& driver, const Command& command) {
    return driver.desk.answer(
        command.text("task"), command.text("option"), command.text("role"), command.by);
}

// Somebody looks at the whole map. There is nothing to show here.
std::string full_map(Driver&, const Command&) { return ""; }

std::string disturb(Driver& driver, const Command& command) {
    std::map<std::string, Json> parameters = command.said;
    parameters.erase("target");
    parameters.erase("kind");
    const std::string target = command.text("target");
    std::string wrong;
    const Disturbance what = disturbance_of(command.text("kind"), parameters, wrong);
    if (!wrong.empty()) {
        return wrong;
    }
    const std::vector<std::string> sensors = driver.run.senses.disturb(target, what);
    if (sensors.empty()) {
        return "nothing called '" + target + "' is sensed";
    }
    Object said = driver.run.event("disturbed");
    said.text("target", target).text("kind", what.kind);
    said.raw("parameters", told_parameters(command, {"target", "kind"}));
    driver.run.tell(said.raw("sensors", json_list(sensors)));
    return "";
}

std::string inject(Driver& driver, const Command& command) {
    const std::string wrong = inject_fault(driver.run.world, driver.run.hierarchy, command.said);
    if (!wrong.empty()) {
        return wrong;
    }
    Object said = driver.run.event("fault_injected");
    said.text("fault", command.text("fault"));
    driver.run.tell(said.raw("parameters", told_parameters(command, {"fault"})));
    return "";
}

}  // namespace dsfo::effects
