// The driver: what a run does at each tick by itself, and how it waits and ends.
#pragma once

#include "run_state.hpp"
#include "supervisor.hpp"

namespace dsfo {

class Driver;

// The admission of a proposed step: facts from people, guards, the supervisor, and consent, each only
// if those before agree (clause 4). The functions return why a step was refused; the text is empty
// if it begins or if people are asked.
class Admission {
public:
    explicit Admission(Driver& driver) : driver_(driver) {}

    std::string proposed;
    bool chosen = false;  // a person asked for the last one

    std::string admit(const StepPointer& step, bool by_person = false);
    void tell_refusal(
        const std::string& edge, const std::vector<std::string>& reasons,
        const std::string& hazard = "");

private:
    std::string guarded(const StepPointer& step, bool by_person);
    std::string supervised(const StepPointer& step);
    std::string ask_to_go_on(const StepPointer& step);
    std::string confirmed(const StepPointer& step, bool by_person, bool fresh);
    std::string begin(const StepPointer& step, bool by_person, bool fresh);
    std::vector<std::string> reasons_against(const JointStep& step) const;
    std::string refuse(
        const StepPointer& step, bool by_person, std::vector<std::string> reasons);
    void obey_person(const StepPointer& step, const Task& task);
    void obey_agent(const StepPointer& step, const Verdict& verdict);
    void skip(const std::string& edge, const std::string& decision, const std::string& reason);
    void tell_command(
        const std::string& word, const std::string& by, const std::string& edge,
        const std::string& reason);

    Driver& driver_;
};

// The arrival at goals: a goal is told only after a fresh check, with readings that are newer than
// the last commit, command or disturbance (clause 9).
class Arrival {
public:
    explicit Arrival(Driver& driver) : driver_(driver) {}

    bool closing = false;  // nobody attends any more: the run ends whatever the check says
    bool moved = false;  // an operation has ended since the last look

    bool open() const;  // at a goal that was not told yet, or at all goals
    void begin(bool by_move = false);  // wait for readings that are newer than now
    void forget() { since_.reset(); }
    void look();

private:
    std::vector<Goal> reached() const;
    std::set<Fact> facts_of(const std::vector<Goal>& goals) const;
    void tell(const std::vector<Goal>& here);

    Driver& driver_;
    std::set<Goal> told_;
    std::optional<double> since_;
};

// What is settled before the first tick.
struct Conduct {
    long seed = 0;
    bool adopts = false;  // a mismatch is resolved by the only configuration that fits
    bool attended = false;  // somebody is there to decide
};

class Driver {
public:
    Driver(LiveRun& live, Course& its_course, Supervisor* supervisor, Conduct its_conduct);

    LiveRun& run;
    Course& course;
    Conduct conduct;
    Reviewer reviewer;
    RunState state;
    bool attended;
    Trouble trouble;
    LoopGuard loops{3};
    LoopGuard repeats{100};  // how often a script may ask for the same
    Desk desk;
    Admission admission{*this};
    Arrival arrival{*this};
    std::unique_ptr<Carrier> carrier;
    std::string reason;  // why it has ended; empty before
    std::string sentence;
    bool told = false;  // the start was told
    bool over = false;  // the run may move

    std::string phase() const { return state.phase(carrier != nullptr, desk.busy()); }
    bool ended() const { return !reason.empty(); }

    void start();  // goes on with the start (clauses 1, 3 and 11)
    void go_on();  // one tick
    void begin(const StepPointer& step, bool by_person);  // all guards have agreed
    void informed(const std::function<void()>& then);  // when people have told what only they know
    bool lost();  // hold if a hazard is met, or a critical fact is false or unknown
    bool endangered();  // hold if the run has begun and a hazard is met
    void recheck();  // state and route, before the run goes on
    void now_paused();
    void paused_or_held(const std::string& why);
    void arrived(bool fresh, bool by_move, const std::string& words);
    void withdraw();  // what was proposed; the next proposal is made anew
    void hold(const std::optional<Hold>& why);
    void release();
    void finish(const std::string& why, const std::string& words);
    void tell_end();  // the last event
    void tell_bypasses(const std::vector<const Edge*>& edges, bool again = false);

private:
    void refuse(const std::string& words, const std::string& advice);
    void tell_start(const std::vector<std::string>& changes);
    void tell_started(const std::vector<std::string>& changes, const std::vector<Check>& checks);
    void accepted();
    std::string findings() const;
    void wait(bool watched);
    bool outlived();
    void live(bool watched);
    void propose();
    StepPointer next_step();
    void carry();
    void after_step();
    void failed(const JointStep& step, const Failure& failure);
    void recheck_others();
    void locate();

    std::set<std::string> bypassed_;
    std::optional<double> broken_since_;
};

}  // namespace dsfo
