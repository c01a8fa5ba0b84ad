// Carries out one joint step, tick by tick: begin, run, settle, check, commit (clauses 5 to 7).
#pragma once

#include "run.hpp"

namespace dsfo {

struct Failure {
    const Edge* edge = nullptr;
    std::string reason;
    bool risky = false;  // the operation itself is to blame
    bool pending = false;  // it failed during a crossing
    std::vector<std::string> lost;  // needed facts that were lost
    bool hazards = false;  // hazards were met, or refused the next function
};

class Carrier {
public:
    enum class Stage { next, running, settling, done, failed };

    Carrier(LiveRun& run, StepPointer step);

    StepPointer step;
    Stage stage = Stage::next;
    Failure failure;

    void advance(const Shut& shut);
    void cut(const std::string& reason);  // end the step as it is: nothing commits any more

private:
    const Action& action() const { return step->actions[at_]; }
    std::set<std::string> uncommitted() const;
    bool notice();  // whether the step has just lost a needed fact, or a hazard is met just now
    std::string lost_words() const;
    std::vector<std::string> lost_facts() const;
    void begin(const Shut& shut);
    void go_on();
    void settle();
    void decide();
    void cancel(const std::string& outcome, const std::string& message);
    void ended(const std::string& outcome, const std::string& message);
    void fail(const std::string& reason, bool risky, bool pending);

    LiveRun& run_;
    std::size_t at_ = 0;
    long calls_ = 0;  // of the function that runs
    double since_ = 0.0;
    double until_ = 0.0;
    std::string fault_;
    std::vector<std::string> lost_;
    bool hazards_ = false;
    std::vector<const Edge*> required_;  // edges that have begun and require facts
    std::set<Fact> changing_;
    std::set<Fact> changed_;
};

}  // namespace dsfo
