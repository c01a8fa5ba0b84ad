#include <algorithm>

#include "driver.hpp"
#include "needed.hpp"

namespace dsfo {

std::string Admission::admit(const StepPointer& step, bool by_person) {
    proposed = step->asked->address;
    chosen = by_person;
    const std::vector<Question> facts = needed_of(driver_.run, *step);
    if (facts.empty()) {
        return guarded(step, by_person);
    }
    const std::string nobody = driver_.desk.ask(facts, [=](const Tasks& closed) {
        const std::string no = no_words(closed);
        no.empty() ? guarded(step, by_person) : refuse(step, by_person, {no});
    });
    return nobody.empty() ? "" : refuse(step, by_person, {nobody});
}

std::vector<std::string> Admission::reasons_against(const JointStep& step) const {
    std::vector<std::string> found;
    for (const Edge* edge : step.edges) {
        const auto shut = driver_.course.shut.find(edge->address);
        if (shut != driver_.course.shut.end()) {
            found.push_back(edge->address + " is " + shut->second);
        }
    }
    return found.empty() ? driver_.run.refusals(step) : found;
}

std::string Admission::guarded(const StepPointer& step, bool by_person) {
    LiveRun& run = driver_.run;
    const std::vector<std::string> reasons = reasons_against(*step);
    if (!reasons.empty() || run.objection(step->asked->address, step->actions)) {
        return refuse(step, by_person, reasons);
    }
    if (by_person) {
        const std::string no = driver_.reviewer.objection(run, *step);
        return no.empty() ? confirmed(step, by_person, true) : refuse(step, by_person, {no});
    }
    const std::string circling = driver_.loops.why_not(run, *step->asked);
    if (!circling.empty()) {
        driver_.course.drop_plan();
        driver_.hold(Hold{circling, {}, "held", {}});
        return circling;
    }
    return supervised(step);
}

std::string Admission::supervised(const StepPointer& step) {
    const Verdict verdict = driver_.reviewer.verdict(driver_.run, *step);
    if (verdict.decision != Decision::allow) {
        obey_agent(step, verdict);
        if (!driver_.desk.busy()) {
            driver_.course.drop_plan();
        }
        return "";
    }
    if (driver_.run.levels.supervision != "human") {
        return confirmed(step, false, true);
    }
    const std::string nobody = ask_to_go_on(step);
    return nobody.empty() ? "" : refuse(step, false, {nobody});
}

std::string Admission::ask_to_go_on(const StepPointer& step) {
    return driver_.desk.ask({supervise_task(*step->asked)}, [=](const Tasks& closed) {
        if (closed.front()->yes()) {
            confirmed(step, false, false);
        } else {
            obey_person(step, *closed.front());
        }
    });
}

// All confirmations are asked for before anything moves.
std::string Admission::confirmed(const StepPointer& step, bool by_person, bool fresh) {
    const Levels& levels = driver_.run.levels;
    std::vector<Question> questions;
    for (const Edge* edge : step->edges) {
        if (levels.people_do(edge->branch) &&
            (!edge->terms->confirm.empty() || levels.operation(*edge) == "shared")) {
            questions.push_back(confirm_task(*edge));
        }
    }
    if (questions.empty()) {
        return begin(step, by_person, fresh);
    }
    const std::string nobody = driver_.desk.ask(questions, [=](const Tasks& closed) {
        const std::string no = no_words(closed);
        no.empty() ? begin(step, by_person, false) : refuse(step, by_person, {no});
    });
    return nobody.empty() ? "" : refuse(step, by_person, {nobody});
}

// If people were asked, time has passed, so the guards are asked again.
std::string Admission::begin(const StepPointer& step, bool by_person, bool fresh) {
    if (!fresh) {
        const std::vector<std::string> reasons = reasons_against(*step);
        if (!reasons.empty() || driver_.run.objection(step->asked->address, step->actions)) {
            return refuse(step, by_person, reasons);
        }
    }
    driver_.begin(step, by_person);
    return "";
}

// Refuses a step, for these reasons or else because of a hazard.
std::string Admission::refuse(
    const StepPointer& step, bool by_person, std::vector<std::string> reasons) {
    const std::string& asked = step->asked->address;
    driver_.course.drop_plan();
    std::string hazard;
    if (reasons.empty()) {
        if (const auto found = driver_.run.objection(asked, step->actions)) {
            reasons = {found->sentence};
            hazard = found->hazard;
        }
    }
    tell_refusal(asked, reasons, hazard);
    if (!by_person) {
        const std::string first = reasons.empty() ? "" : reasons.front();
        driver_.hold(Hold{
            asked + " cannot begin: " + first, reasons, hazard.empty() ? "held" : "hazard", {}});
    }
    return joined(reasons, "; ");
}

void Admission::obey_person(const StepPointer& step, const Task& task) {
    if (task.answer() == nullptr) {
        refuse(step, false, {task.why()});
        return;
    }
    driver_.course.drop_plan();
    const std::string edge = step->asked->address;
    const std::string decision = task.answer()->value;
    const std::string by = task.who();
    tell_command(decision, by, edge, "");
    if (decision == "pause") {
        driver_.paused_or_held(by + " wants a pause before " + edge);
    } else {
        skip(edge, decision, "");
    }
}

void Admission::obey_agent(const StepPointer& step, const Verdict& verdict) {
    const std::string edge = step->asked->address;
    const std::string name = driver_.reviewer.name();
    tell_command(word_of(verdict.decision), name, edge, verdict.reason);
    if (verdict.decision == Decision::pause) {
        driver_.paused_or_held(name + " wants a pause before " + edge + ": " + verdict.reason);
    } else if (verdict.decision == Decision::ask) {
        if (!ask_to_go_on(step).empty()) {
            driver_.hold(
                Hold{name + " asks about " + edge + ": " + verdict.reason, {}, "held", {}});
        }
    } else {
        const std::string why = verdict.reason.empty() ? "" : ": " + verdict.reason;
        tell_refusal(edge, {name + " says no" + why});
        skip(edge, word_of(verdict.decision), verdict.reason);
    }
}

// Excludes an operation until it is restored, or skips it once.
void Admission::skip(
    const std::string& edge, const std::string& decision, const std::string& reason) {
    if (decision == "prune") {
        driver_.course.prune(edge, reason);
        Object said = driver_.run.event("operation_pruned");
        driver_.run.tell(said.text("address", edge).text("reason", reason));
    } else {
        driver_.course.veto(edge, driver_.run.configuration);
    }
}

void Admission::tell_refusal(
    const std::string& edge, const std::vector<std::string>& reasons,
    const std::string& hazard) {
    Object said = driver_.run.event("operation_refused");
    said.text("address", edge).raw("reasons", json_list(reasons));
    if (!hazard.empty()) {
        said.text("code", "hazard").text("hazard", hazard);
    }
    driver_.run.tell(said);
}

void Admission::tell_command(
    const std::string& word, const std::string& by, const std::string& edge,
    const std::string& reason) {
    Object said = driver_.run.event("commanded");
    said.text("command", word).text("by", by).text("address", edge).text("value", "");
    driver_.run.tell(said.text("reason", reason).text("refused", ""));
}

}  // namespace dsfo
