// A world that is a program elsewhere, over the protocol of SMSL Studio (its docs/remote.md). Nothing
// that it says is believed before it is checked; where it is wrong, late or gone, the run ends.
#pragma once

#include <set>

#include "wire.hpp"
#include "world.hpp"

namespace dsfo {

class RemoteWorld : public World {
public:
    // `token` is empty for a Unix socket. `seed` goes to the program.
    RemoteWorld(
        const Hierarchy& hierarchy, std::string address, std::string token, long seed,
        Hurry hurry);
    ~RemoteWorld() override;
    RemoteWorld(const RemoteWorld&) = delete;
    RemoteWorld& operator=(const RemoteWorld&) = delete;

    std::string name() const override { return "remote"; }
    double tick() const override { return tick_; }
    double settle() const override { return settle_; }
    void begin(const Configuration& start) override;
    void step() override;
    void brake() override;
    std::optional<std::string> sense(Fact fact) const override;
    Outcome carry_out(const Edge& edge) override;
    std::string lost() const override { return lost_; }

private:
    struct Sensor {
        Fact fact;
        double max_age = 0.3;
        std::vector<std::string> values;  // that it may read
        std::optional<std::string> value;
        double time = -1.0;  // of its last valid sample
        double sequence = -1.0;
    };

    std::string open(const Configuration& start);
    std::string hello();
    std::string take_offer(const Json& offer);
    std::string take_operations(const Json& offer);
    std::string take_sensors(const Json& offer);
    std::string take_samples(const Json& moment);
    std::string take_tick(const Json& moment);
    std::string start_members(const Configuration& start) const;
    std::optional<Fact> fact_of(const std::string& text) const;
    double time() const { return static_cast<double>(ticks_) * tick_; }
    void lose(const std::string& why);  // stop it first
    void end(const std::string& why, bool stopped);

    const Hierarchy& hierarchy_;
    std::string address_;
    std::string token_;
    long seed_;
    Wire wire_;
    double tick_ = 0.05;
    double settle_ = 0.0;
    long ticks_ = 0;
    std::map<std::string, std::string> functions_;  // by address, or by the name of an operation
    std::map<std::pair<std::string, std::string>, Sensor> sensors_;  // by fact and name
    std::set<std::pair<std::string, std::string>> unbound_;  // sensors that nothing here asks
    std::string running_;  // the address of the operation that moves
    Outcome outcome_ = Outcome::running;
    std::string lost_;
};

// The token in a file, which only its owner may read. `wrong` says why there is none.
std::string token_in(const std::string& file, std::string& wrong);

}  // namespace dsfo
