// The supervisor: an agent that is asked before every operation, after all guards.
#pragma once

#include "run.hpp"

namespace dsfo {

// What a supervisor sees: where the run stands, and the step that it proposes.
struct Proposal {
    double time = 0.0;
    std::string operation;
    std::vector<std::string> operations;
    std::string risk;  // low, medium, high, or empty if none is declared
    double cost = 0.0;
};

enum class Decision { allow, veto, prune, pause, ask };

struct Verdict {
    Decision decision = Decision::allow;
    std::string reason;
};

std::string word_of(Decision decision);

// It must answer at once. If it needs time, it answers ask or pause.
class Supervisor {
public:
    virtual ~Supervisor() = default;
    virtual std::string name() const = 0;
    virtual Verdict review(const Proposal& proposal) = 0;
};

// The agent of the level `automatic`: it allows declared risks up to medium.
class RiskLimit : public Supervisor {
public:
    std::string name() const override { return "risk limit medium"; }
    Verdict review(const Proposal& proposal) override;
};

// Asks the supervisor, if there is one. If it has paused the run and a person lets it go on, the
// same step is not reviewed again.
class Reviewer {
public:
    explicit Reviewer(Supervisor* supervisor) : supervisor_(supervisor) {}

    std::string name() const { return supervisor_ == nullptr ? "" : supervisor_->name(); }
    Verdict verdict(const LiveRun& run, const JointStep& step);
    std::string objection(const LiveRun& run, const JointStep& step);  // to what a person asked for
    void trust() { trusted_ = doubtful_.has_value(); }
    void forget();

private:
    Verdict review(const LiveRun& run, const JointStep& step);

    Supervisor* supervisor_;
    std::optional<std::pair<Configuration, std::string>> doubtful_;
    bool trusted_ = false;
};

}  // namespace dsfo
