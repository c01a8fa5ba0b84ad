// Tasks: questions to people while a run waits. None has a default answer, and no time-out is a yes.
#pragma once

#include <deque>
#include <functional>

#include "run.hpp"

namespace dsfo {

// A possible answer: its value in the log, its words, and whether the run may go on with it.
struct Option {
    std::string value;
    std::string words;
    bool yes = false;
};

// What is asked of whom. `roles` has one role for each person who must agree. `kind` is operation,
// confirm, fact, supervise or start. Times are seconds.
struct Question {
    std::string kind;
    std::string address;
    std::string words;
    std::vector<Option> options;
    std::vector<std::string> roles{""};
    std::optional<double> within;
    std::string escalation;
    std::optional<Fact> fact;
};

struct Said {
    std::string by;
    std::string role;
    Option option;
};

// An open or closed question. `outcome` is empty while it is open, else answered, disagreed,
// timed_out or withdrawn.
struct Task {
    std::string name;
    Question question;
    double opened = 0.0;
    bool escalated = false;
    std::vector<Said> said;
    std::string outcome;

    double within() const { return question.within.value_or(120.0); }
    double deadline() const { return opened + within(); }
    const Option* answer() const;  // the answer on which all agree, else nullptr
    bool yes() const;
    std::string who() const;
    std::string why() const;  // why it does not let the run go on
};

using Tasks = std::vector<const Task*>;
using Then = std::function<void(const Tasks&)>;

// Why some answers do not let the run go on; empty if they do.
std::string no_words(const Tasks& closed);

// Puts one group of questions to people, and calls back with the answers: when all are answered, or
// when one of them is not a yes.
class Desk {
public:
    Desk(LiveRun& run, const bool& attended) : run_(run), attended_(attended) {}

    std::function<void(const Task&)> opened;  // called with every task that opens

    bool busy() const { return static_cast<bool>(then_); }
    bool keeps() const { return busy() && keep_; }  // people tell the facts of the procedure
    std::vector<const Task*> open() const;  // oldest first
    std::string nobody() const;

    // Put questions to people. Why that is not possible; empty if it is.
    std::string ask(const std::vector<Question>& questions, Then then, bool keep = false);

    // Take an answer to a task, named by its name or its address. Why it does not count, or empty.
    std::string answer(
        const std::string& text, const std::string& option, const std::string& role,
        const std::string& by);

    void pass_time();  // at half time another role may answer, too; at the deadline a task ends
    bool settled();  // whether the answers are complete; then the callback was called
    void withdraw();  // the run has moved on, nobody is called back

private:
    Task* found(const std::string& text);
    void put(const Question& question);
    void withdraw_open();
    void close(Task& task, const std::string& outcome);
    std::string refusal(
        const Task* task, const std::string& name, const std::string& option,
        const std::string& by, const std::string& role) const;

    LiveRun& run_;
    const bool& attended_;
    std::deque<Task> tasks_;
    std::size_t group_ = 0;  // where the present group begins
    Then then_;
    bool keep_ = false;
};

Question operation_task(const Edge& edge);
Question confirm_task(const Edge& edge);
Question supervise_task(const Edge& edge);
Question start_task();
Question fact_task(const Hierarchy& hierarchy, Fact fact);
std::string title_of(const Edge& edge);

}  // namespace dsfo
