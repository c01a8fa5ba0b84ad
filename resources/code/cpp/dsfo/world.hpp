// Worlds: what moves and is sensed, in ticks. The table world keeps facts and has no physics.
#pragma once

#include "hierarchy.hpp"

namespace dsfo {

// A world of your own overrides these. Times are seconds.
class World {
public:
    virtual ~World() = default;

    virtual std::string name() const = 0;
    virtual double tick() const { return 0.05; }
    virtual double settle() const { return 0.0; }  // until a state check decides
    virtual void begin(const Configuration& start) = 0;  // take the world to the start
    virtual void step() {}  // let one tick pass
    virtual void brake() {}  // stop all that moves
    virtual std::optional<std::string> sense(Fact fact) const = 0;
    virtual std::string lost() const { return ""; }  // why it is gone; the run ends then

    // What an operation does where nobody has written anything else.
    virtual Outcome carry_out(const Edge& edge) = 0;
};

// A table of facts: an operation writes the facts of its target (clause 14).
class TableWorld : public World {
public:
    explicit TableWorld(const Hierarchy& hierarchy) : hierarchy_(hierarchy) {}

    std::string name() const override { return "table"; }
    void begin(const Configuration& start) override;
    std::optional<std::string> sense(Fact fact) const override;
    Outcome carry_out(const Edge& edge) override;
    void brake() override { hangs_ = false; }

    // Faults, for trials. `spoil` says what befalls the next operation, or the one at an address;
    // it may end in a state that it does not lead to.
    void set_fact(Fact fact, const std::string& value) { facts_[fact] = value; }
    void spoil(
        const std::string& fault, const std::string& at,
        const std::optional<std::pair<int, int>>& elsewhere);

private:
    void write(int branch, int state);
    Outcome spoilt();

    const Hierarchy& hierarchy_;
    std::map<Fact, std::string> facts_;
    std::string fault_;
    std::string fault_at_;
    std::optional<std::pair<int, int>> elsewhere_;
    bool hangs_ = false;  // the present operation never ends
};

}  // namespace dsfo
