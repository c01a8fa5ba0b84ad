// Carries out one joint step, tick by tick: begin, run, settle, check, commit (clauses 5 to 7).
#pragma once

#include "people.hpp"

namespace dsfo {

struct Failure {
    const Edge* edge = nullptr;
    std::string reason;
    bool risky = false;  // the operation itself is to blame
    bool pending = false;  // it failed during a crossing
    bool unanswered = false;  // people did not answer
    std::vector<std::string> lost;  // needed facts that were lost
    bool hazards = false;  // hazards were met, or refused the next function
};

class Carrier {
public:
    enum class Stage { next, running, asking, settling, done, failed };

    Carrier(LiveRun& run, StepPointer step);

    StepPointer step;
    Stage stage = Stage::next;
    Failure failure;
    std::vector<Question> wants;  // what people must answer while the stage is asking

    void advance(const Shut& shut);  // one tick; `shut` are the edges that must not begin

    // End the operation, as it declares, if a fact that the step needs is false or unknown. In any
    // case nothing commits any more.
    void watch();

    void answered(const Tasks& closed);
    void unanswered(const std::string& reason);  // nobody is there to answer
    void abort(const std::string& reason);  // fails when the world has settled; nothing is risky

    // End the step as it is: nothing settles or commits any more. The facts that it may have
    // changed.
    std::set<Fact> cut(const std::string& reason);

    const Edge& edge() const { return *action().edge; }
    bool moving() const;
    bool can_freeze() const;  // a pause may freeze the step as it is
    std::set<std::string> uncommitted() const;
    std::set<Fact> touched() const;

private:
    const Action& action() const;
    bool person_acts() const { return stage == Stage::asking && wants.front().kind == "operation"; }
    bool notice();  // whether the step has just lost a needed fact, or a hazard is met just now
    std::string lost_words() const;
    std::vector<std::string> lost_facts() const;
    std::string barred(const Shut& shut) const;
    std::string refusal();
    void begin(const Shut& shut);
    void start_function();
    void go_on();
    void settle();
    void decide();
    void succeed();
    void want(const std::vector<Question>& questions);
    void person_ended(const Task& task, const std::string& no);
    void end_asking(const std::string& reason);
    void cancel(const std::string& outcome, const std::string& message);
    void ended(const std::string& outcome, const std::string& message);
    void fail(const std::string& reason, bool risky, bool pending);
    void fail(const std::string& reason, bool risky);

    LiveRun& run_;
    std::size_t at_ = 0;
    long calls_ = 0;  // of the function that runs
    double since_ = 0.0;
    double until_ = 0.0;
    std::string fault_;
    std::string by_;  // who has carried it out
    bool blame_ = true;
    bool answerable_ = true;
    bool unanswered_ = false;
    std::vector<std::string> lost_;
    bool hazards_ = false;
    std::vector<const Edge*> required_;  // edges that have begun and require facts
    std::set<Fact> changing_;
    std::set<Fact> changed_;
};

}  // namespace dsfo
