#include "people.hpp"

#include <algorithm>

#include "names.hpp"

namespace dsfo {

namespace {

constexpr double hair = 1e-9;
const char* const nobody_there = "nobody is there to answer";

std::string over(const std::string& outcome) {
    return outcome == "answered"    ? "it was answered already"
           : outcome == "disagreed" ? "it is over: the answers differed"
           : outcome == "timed_out" ? "it is too late, the time ran out"
                                    : "it was withdrawn, the run has moved on";
}

std::vector<std::string> or_anybody(const std::vector<std::string>& roles) {
    return roles.empty() ? std::vector<std::string>{""} : roles;
}

std::string without_empty(const std::vector<std::string>& roles) {
    std::vector<std::string> found;
    std::copy_if(
        roles.begin(), roles.end(), std::back_inserter(found),
        [](const std::string& role) { return !role.empty(); });
    return joined(found, ", ");
}

bool is_nameless(const std::string& who) { return who == "aperson" || who == "script"; }

}  // namespace

const Option* Task::answer() const {
    return outcome == "answered" ? &said.front().option : nullptr;
}

bool Task::yes() const { return answer() != nullptr && answer()->yes; }

std::string Task::who() const {
    std::vector<std::string> names;
    for (const Said& one : said) {
        names.push_back(one.by);
    }
    return names.empty() ? "nobody" : joined(names, " and ");
}

std::string Task::why() const {
    const std::string asked = "\"" + question.words + "\"";
    if (answer() != nullptr) {
        return who() + " answered \"" + answer()->words + "\" to " + asked;
    }
    if (outcome == "timed_out") {
        return (said.empty() ? "nobody" : "only " + who()) + " answered " + asked + " within " +
               plain_number(within()) + " s";
    }
    if (outcome == "disagreed") {
        return who() + " did not give the same answer to " + asked;
    }
    return asked + " was withdrawn";
}

std::string no_words(const Tasks& closed) {
    for (const Task* task : closed) {
        if (!task->yes()) {
            return task->why();
        }
    }
    return "";
}

// the desk ------------------------------------------------------------------------------------------

std::vector<const Task*> Desk::open() const {
    std::vector<const Task*> found;
    for (const Task& task : tasks_) {
        if (task.outcome.empty()) {
            found.push_back(&task);
        }
    }
    return found;
}

std::string Desk::nobody() const {
    const std::vector<const Task*> waiting = open();
    return nobody_there +
           (waiting.empty() ? "" : " \"" + waiting.front()->question.words + "\"");
}

std::string Desk::ask(const std::vector<Question>& questions, Then then, bool keep) {
    if (!attended_) {
        return std::string(nobody_there) + " \"" + questions.front().words + "\"";
    }
    withdraw();
    group_ = tasks_.size();
    for (const Question& question : questions) {
        put(question);
    }
    then_ = std::move(then);
    keep_ = keep;
    return "";
}

void Desk::put(const Question& question) {
    Task task;
    task.name = "task-" + std::to_string(tasks_.size() + 1);
    task.question = question;
    task.opened = run_.time();
    std::vector<std::string> options;
    for (const Option& option : question.options) {
        options.push_back(option.value);
    }
    Object said = run_.event("task_opened");
    said.text("task", task.name).text("kind", question.kind).text("address", question.address);
    said.text("question", question.words).raw("options", json_list(options));
    said.text("role", without_empty(question.roles));
    said.count("persons", static_cast<long>(question.roles.size()));
    run_.tell(said.number("deadline", task.deadline()));
    tasks_.push_back(task);
    try {
        if (opened) {
            opened(tasks_.back());
        }
    } catch (...) {  // code of others may throw anything; the task stays open
    }
}

std::string Desk::answer(
    const std::string& text, const std::string& option, const std::string& role,
    const std::string& by) {
    pass_time();
    Task* const task = found(text);
    const std::string name = task == nullptr ? text : task->name;
    const std::string refused = refusal(task, name, option, by, role);
    Object told = run_.event("task_answered");
    told.text("task", name).text("by", by).text("role", role);
    run_.tell(told.text("refused", refused));
    if (task == nullptr || !refused.empty()) {
        return refused;
    }
    const std::vector<Option>& options = task->question.options;
    const auto chosen = std::find_if(
        options.begin(), options.end(),
        [&option](const Option& one) { return one.value == option; });
    task->said.push_back(Said{by, role, *chosen});
    if (task->said.size() == task->question.roles.size()) {
        const bool same = std::all_of(
            task->said.begin(), task->said.end(),
            [&option](const Said& one) { return one.option.value == option; });
        close(*task, same ? "answered" : "disagreed");
    }
    return "";
}

Task* Desk::found(const std::string& text) {
    Task* only = nullptr;
    int count = 0;
    for (Task& task : tasks_) {
        if (task.name == text) {
            return &task;
        }
        if (task.outcome.empty() && (text.empty() || text == task.question.address)) {
            only = &task;
            ++count;
        }
    }
    return count == 1 ? only : nullptr;
}

void Desk::pass_time() {
    const double now = run_.time();
    for (Task& task : tasks_) {
        if (!task.outcome.empty()) {
            continue;
        }
        if (now >= task.opened + task.within() / 2 - hair && !task.escalated) {
            task.escalated = true;
            Object said = run_.event("task_escalated");
            run_.tell(said.text("task", task.name).text("role", task.question.escalation));
        }
        if (now >= task.deadline() - hair) {
            close(task, "timed_out");
        }
    }
}

bool Desk::settled() {
    Tasks closed;
    for (std::size_t at = group_; at < tasks_.size(); ++at) {
        if (!tasks_[at].outcome.empty()) {
            closed.push_back(&tasks_[at]);
        }
    }
    const bool whole = closed.size() == tasks_.size() - group_;
    if (!then_ || (!whole && no_words(closed).empty())) {
        return false;
    }
    Then then;
    std::swap(then, then_);
    group_ = tasks_.size();
    withdraw_open();
    then(closed);
    return true;
}

void Desk::withdraw() {
    if (then_) {
        then_ = nullptr;
        group_ = tasks_.size();
        withdraw_open();
    }
}

void Desk::withdraw_open() {
    for (Task& task : tasks_) {
        if (task.outcome.empty()) {
            close(task, "withdrawn");
        }
    }
}

void Desk::close(Task& task, const std::string& outcome) {
    task.outcome = outcome;
    std::vector<std::pair<std::string, std::string>> answers;
    if (task.said.size() == task.question.roles.size()) {
        for (const Said& one : task.said) {
            answers.emplace_back(one.by, one.option.value);
        }
    }
    const std::string answer = task.answer() == nullptr ? "" : task.answer()->value;
    Object said = run_.event("task_closed");
    said.text("task", task.name).text("outcome", outcome).text("answer", answer);
    run_.tell(said.raw("answers", json_map(answers)));
    if (task.question.fact && task.yes()) {
        std::vector<std::string> names;
        for (const auto& one : answers) {
            names.push_back(one.first);
        }
        run_.take_answer(*task.question.fact, answer, joined(names, ", "));
    }
}

std::string Desk::refusal(
    const Task* task, const std::string& name, const std::string& option, const std::string& by,
    const std::string& role) const {
    if (task == nullptr) {
        return "there is no open task '" + name + "'";
    }
    if (!task->outcome.empty()) {
        return over(task->outcome);
    }
    const Question& question = task->question;
    bool known = true;
    const std::string who = same_name(by, known);
    if (who.empty()) {
        return "an answer needs the name of a person";
    }
    const std::size_t many = question.roles.size();
    if (many > 1 && is_nameless(who)) {
        return std::to_string(many) +
               " persons must be told apart, say the name of who answers";
    }
    if (many > 1 && !known) {
        return std::to_string(many) + " persons must be told apart, and this program compares " +
               "only names in Latin, Greek or Cyrillic letters";
    }
    std::vector<std::string> given;
    for (const Said& one : task->said) {
        if (same_name(one.by) == who) {
            return by + " has answered already; another person must";
        }
        given.push_back(one.role);
    }
    std::vector<std::string> values;
    for (const Option& one : question.options) {
        values.push_back(one.value);
    }
    if (std::find(values.begin(), values.end(), option) == values.end()) {
        return "'" + option + "' is no answer to it, choose one of " + joined(values, ", ");
    }
    given.push_back(role);
    if (!seated(question.roles, given, task->escalated ? question.escalation : "")) {
        std::vector<std::string> asked;
        for (const std::string& one : question.roles) {
            asked.push_back(one.empty() ? "anybody" : one);
        }
        const bool nameless = same_name(role).empty();
        return (nameless ? "a person without a role" : "the role " + role) +
               " may not answer it, it is asked of " + joined(asked, ", ");
    }
    return "";
}

// the questions -------------------------------------------------------------------------------------

std::string title_of(const Edge& edge) {
    return edge.terms->title.empty() ? edge.name : edge.terms->title;
}

Question operation_task(const Edge& edge) {
    const Asked& asked = edge.terms->asked;
    const std::string words =
        asked.question.empty() ? title_of(edge) + ": please carry it out" : asked.question;
    return Question{
        "operation", edge.address, words,
        {{"done", "Done", true}, {"could_not", "Could not do it", false}},
        or_anybody(asked.roles), asked.within, asked.escalates_to, std::nullopt};
}

Question confirm_task(const Edge& edge) {
    const Asked& asked = edge.terms->asked;
    return Question{
        "confirm", edge.address, title_of(edge) + ": may it begin?",
        {{"confirm", "Confirm", true}, {"refuse", "Do not begin", false}},
        or_anybody(edge.terms->confirm), asked.within, asked.escalates_to, std::nullopt};
}

Question supervise_task(const Edge& edge) {
    return Question{
        "supervise", edge.address, title_of(edge) + ": shall it begin?",
        {{"go_on", "Go on", true}, {"veto", "Skip it once", false},
         {"prune", "Shut it out of this run", false}, {"pause", "Pause the run", false}},
        {""}, std::nullopt, "", std::nullopt};
}

Question start_task() {
    return Question{
        "start", "", "Shall the run start?",
        {{"start", "Start", true}, {"refuse", "Do not start", false}},
        {""}, std::nullopt, "", std::nullopt};
}

Question fact_task(const Hierarchy& hierarchy, Fact fact) {
    const Branch& branch = hierarchy.of(fact.first);
    const Flag& flag = hierarchy.blueprint.flag(fact);
    std::vector<std::string> values = flag.values;
    for (const auto& one : flag.meanings) {
        values.push_back(one.first);
    }
    values.insert(values.end(), flag.failure.begin(), flag.failure.end());
    Question made;
    for (const std::string& value : values) {
        const bool known = std::any_of(
            made.options.begin(), made.options.end(),
            [&value](const Option& one) { return one.value == value; });
        const auto meaning = std::find_if(
            flag.meanings.begin(), flag.meanings.end(),
            [&value](const auto& one) { return one.first == value; });
        if (!known) {
            const bool plain = meaning == flag.meanings.end();
            made.options.push_back(Option{value, plain ? value : meaning->second, true});
        }
    }
    std::string unsure = "cannot say";
    while (std::find(values.begin(), values.end(), unsure) != values.end()) {
        unsure += "?";
    }
    made.options.push_back(Option{unsure, "I cannot say", false});
    made.kind = "fact";
    made.address = hierarchy.blueprint.fact_text(fact);
    made.words = flag.asked.question;
    if (made.words.empty()) {
        made.words = "What is " + branch.fact_name(fact.second) + " of " + branch.name +
                     (flag.unit.empty() ? "" : ", in " + flag.unit) + "?";
    }
    made.roles = or_anybody(flag.asked.roles);
    made.within = flag.asked.within;
    made.escalation = flag.asked.escalates_to;
    made.fact = fact;
    return made;
}

}  // namespace dsfo
