// The player of a script: it gives the commands that are due before the next tick.
//
// Moments depend on simulated time and events alone, so equal runs get equal commands.
#pragma once

#include "dispatcher.hpp"
#include "script.hpp"

namespace dsfo {

// An act whose moment is known, and the task that it answers. `turn` counts down ticks.
struct Due {
    double time = 0.0;
    const Act* act = nullptr;
    std::string task;
    long turn = 1;
};

// Follows the events of a run, and finds the acts whose moments have come.
class Moments {
public:
    explicit Moments(const std::vector<Act>& acts) : acts_(acts) {}

    void met(const Json& event, std::vector<Due>& due);
    bool is_over(const Due& due) const;  // its moment has come and has passed already

private:
    void arrived(const Json& states, double time, std::vector<Due>& due);
    void named(Moment moment, const std::string& at, double time, std::vector<Due>& due);
    void asked(const Json& event, double time, std::vector<Due>& due);

    const std::vector<Act>& acts_;
    std::map<std::pair<Moment, std::string>, long> counts_;
    std::map<long, long> asked_;
    std::set<std::string> going_;
    std::set<std::string> open_;
    std::map<std::string, std::string> configuration_;
};

// Call `before` before every tick, and `hear` with its events.
class Player {
public:
    explicit Player(const Script& script);

    void before(Dispatcher& dispatcher);
    void hear(const std::vector<std::string>& events);
    std::vector<const Act*> left() const;  // the acts whose moments never came

private:
    std::vector<Due> come(const Dispatcher& dispatcher) const;
    std::vector<Due> ready(const Dispatcher& dispatcher, const std::vector<Due>& come) const;
    void forget(const Due& due);
    void carry_out(const Due& due, Dispatcher& dispatcher);

    const Script& script_;
    Moments moments_;
    std::vector<Due> due_;
    std::set<long> left_;  // lines
    const Act* asking_ = nullptr;
    std::string resuming_;
    bool by_hand_ = false;
};

}  // namespace dsfo
