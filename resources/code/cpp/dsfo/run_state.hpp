// The run state: whether the plan, a person or nobody lets the run move now.
#pragma once

#include "trouble.hpp"

namespace dsfo {

// `once`: it carries out one operation and then waits again. `frozen`: it is paused in the middle of
// a step. `pausing`: it will pause when the operation has ended. `stopped` and `taken_over`: who did
// it. `offered` is what giving back has found.
struct RunState {
    bool by_hand = false;
    bool paused = false;
    bool pausing = false;
    bool once = false;
    bool frozen = false;
    std::optional<Hold> held;
    std::string taken_over;
    std::string stopped;
    std::optional<Configuration> offered;
    std::set<Fact> touched;

    std::string phase(bool carrying, bool asking) const;  // in one word
    void pause(bool carrying);
    void resume();
    void step();
    void begin(bool chosen);  // a step begins; `chosen`: a person asked for it
    void hold(const Hold& why);
    void latch(const std::string& by_stop = "", const std::string& by_take_over = "");
};

// Counts how often edges were begun from one configuration, so that no run circles for ever.
class LoopGuard {
public:
    explicit LoopGuard(int most) : most_(most) {}

    std::string why_not(const LiveRun& run, const Edge& edge) const;  // empty if it may begin
    void count(const LiveRun& run, const Edge& edge) {
        ++begun_[{edge.address, run.configuration}];
    }
    void forget() { begun_.clear(); }

private:
    int most_;
    std::map<std::pair<std::string, Configuration>, int> begun_;
};

std::string states_text(const LiveRun& run, const Configuration& configuration);

}  // namespace dsfo
