// The senses of a run: from samples and answers of people to the scene (clauses 9 and 13).
//
// A fact ages from the arrival of its newest sample. One that is too old is unknown.
#pragma once

#include <limits>

#include "disturbance.hpp"
#include "levels.hpp"
#include "world.hpp"

namespace dsfo {

// The value of a fact, or why it is unknown.
struct Reading {
    std::optional<std::string> value;
    std::string reason;
};

// The sensor of one fact: its newest sample, and when that arrived.
class Source {
public:
    Source(std::string its_name, double age) : name(std::move(its_name)), max_age_(age) {}

    void take(const Sample& sample, double now);  // if it is newer than all before, and not late
    Reading reading(double now) const;

    std::string name;
    std::optional<Sample> newest;
    long read = 0;
    long counted = 0;

private:
    double max_age_;
    double received_ = 0.0;
    double quickest_ = std::numeric_limits<double>::infinity();
};

class Senses {
public:
    Senses(const Hierarchy& hierarchy, const World& world, const Levels& levels, long seed);

    std::map<Fact, Reading> scene;

    void look(double now);  // read every sensor
    void answer(Fact fact, const std::string& value, const std::string& who, double now);

    // Forget what people have said about these facts. False if they have said nothing.
    bool forget(const std::set<Fact>& facts, double now);

    // Facts are unknown until each of their sources has sent something new.
    void doubt(const std::set<Fact>& facts, const std::string& reason, double now);

    // Those of some facts that rest on a reading which is not newer than a time.
    std::vector<Fact> late(double since, const std::set<Fact>& facts, double now) const;

    // Disturb a sensor, or the sensor of a fact. The names of the sensors; empty: there is none.
    std::vector<std::string> disturb(const std::string& target, const Disturbance& what);

    bool knows(Fact fact) const { return facts_.count(fact) > 0; }

private:
    struct Answer {
        std::string who;
        std::optional<std::string> value;
        double time = 0.0;
    };
    struct Sensed {
        std::string level;
        Source source;
        std::optional<double> max_age;  // of an answer
        std::optional<Answer> answer;

        Reading answered(double now) const;
        Reading reading(double now) const;
    };
    struct Doubt {
        std::string reason;
        double since = 0.0;
        std::map<std::string, long> counted;  // samples by then, of the sources that are awaited
    };
    struct Told {
        std::string name;
        long count = 0;
        std::optional<double> read;
        bool known = false;
    };

    std::optional<std::string> read(Fact fact) const;
    std::vector<Told> sources(const Sensed& fact, double now) const;
    void dispel(double now);
    void update(double now);

    const Hierarchy& hierarchy_;
    const World& world_;
    long seed_;
    std::map<Fact, Sensed> facts_;
    std::map<Fact, Doubt> doubts_;
    std::map<Fact, DisturbedSensor> disturbed_;
};

}  // namespace dsfo
