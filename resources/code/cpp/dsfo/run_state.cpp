#include "run_state.hpp"

namespace dsfo {

std::string RunState::phase(bool carrying, bool asking) const {
    if (!stopped.empty() || !taken_over.empty()) {
        return stopped.empty() ? "taken_over" : "stopped";
    }
    if (asking || carrying) {
        return frozen ? "paused" : asking ? "waiting" : "running";
    }
    if (held) {
        return held->kind == "no_route" ? "no_route" : "fault_hold";
    }
    if (paused || frozen) {
        return "paused";
    }
    return by_hand && !once ? "ready" : "running";
}

void RunState::pause(bool carrying) {
    paused = true;
    pausing = false;
    once = false;
    frozen = carrying;
}

void RunState::resume() {
    paused = false;
    pausing = false;
    frozen = false;
    once = false;
}

void RunState::step() {
    resume();
    once = true;
}

// If a person chose it while the run held, it is paused afterwards.
void RunState::begin(bool chosen) {
    paused = paused || (chosen && held && !by_hand);
    held.reset();
}

void RunState::hold(const Hold& why) {
    held = why;
    once = false;
    pausing = false;
    paused = false;
}

// Clears everything that would go on by itself.
void RunState::latch(const std::string& by_stop, const std::string& by_take_over) {
    resume();
    held.reset();
    offered.reset();
    stopped = by_stop;
    taken_over = by_take_over;
}

std::string states_text(const LiveRun& run, const Configuration& configuration) {
    std::vector<std::string> found;
    for (const int one : run.hierarchy.order) {
        const Branch& branch = run.hierarchy.of(one);
        const int state = configuration[static_cast<std::size_t>(one)];
        found.push_back(
            branch.name + "/" + branch.states[static_cast<std::size_t>(state)].name);
    }
    return joined(found, ", ");
}

std::string LoopGuard::why_not(const LiveRun& run, const Edge& edge) const {
    const auto known = begun_.find({edge.address, run.configuration});
    if (known == begun_.end() || known->second < most_) {
        return "";
    }
    return edge.address + " was begun " + std::to_string(most_) + " times from " +
           states_text(run, run.configuration) + " without getting further.";
}

}  // namespace dsfo
