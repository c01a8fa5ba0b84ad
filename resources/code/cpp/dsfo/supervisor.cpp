#include "supervisor.hpp"

#include <algorithm>

namespace dsfo {

namespace {

int rank_of(const std::string& risk) {
    return risk == "low" ? 1 : risk == "medium" ? 2 : risk == "high" ? 3 : 0;
}

}  // namespace

std::string word_of(Decision decision) {
    switch (decision) {
        case Decision::allow:
            return "allow";
        case Decision::veto:
            return "veto";
        case Decision::prune:
            return "prune";
        case Decision::pause:
            return "pause";
        case Decision::ask:
            break;
    }
    return "ask";
}

Verdict RiskLimit::review(const Proposal& proposal) {
    if (rank_of(proposal.risk) == 0) {
        return Verdict{Decision::ask, "No risk is declared for " + proposal.operation + "."};
    }
    if (proposal.risk == "high") {
        return Verdict{Decision::veto, "Its risk is high, above the limit of medium."};
    }
    return Verdict{Decision::allow, "Its risk is " + proposal.risk + "."};
}

Verdict Reviewer::verdict(const LiveRun& run, const JointStep& step) {
    const std::pair<Configuration, std::string> here{run.configuration, step.asked->address};
    const bool trusted = trusted_ && doubtful_ == here;
    forget();
    if (supervisor_ == nullptr || trusted) {
        return {};
    }
    const Verdict found = review(run, step);
    if (found.decision == Decision::pause) {
        doubtful_ = here;
    }
    return found;
}

std::string Reviewer::objection(const LiveRun& run, const JointStep& step) {
    if (supervisor_ == nullptr) {
        return "";
    }
    const Verdict found = review(run, step);
    if (found.decision != Decision::veto && found.decision != Decision::prune) {
        return "";
    }
    return name() + " says no" + (found.reason.empty() ? "" : ": " + found.reason);
}

void Reviewer::forget() {
    doubtful_.reset();
    trusted_ = false;
}

Verdict Reviewer::review(const LiveRun& run, const JointStep& step) {
    Proposal proposal{run.time(), step.asked->address, {}, "", step.cost};
    for (const Edge* edge : step.edges) {
        if (edge != step.edges.front()) {
            proposal.operations.push_back(edge->address);
        }
        if (rank_of(edge->terms->risk) > rank_of(proposal.risk)) {
            proposal.risk = edge->terms->risk;
        }
    }
    proposal.operations.push_back(step.asked->address);
    try {
        return supervisor_->review(proposal);
    } catch (...) {  // code of others may throw anything
        return Verdict{Decision::ask, "it failed, it threw an exception"};
    }
}

}  // namespace dsfo
