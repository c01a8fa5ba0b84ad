// Disturbances of sensors, for trials: stuck, drift, noise, dropout in this order, then delay.
#pragma once

#include <map>

#include "chance.hpp"
#include "json_reader.hpp"

namespace dsfo {

// One reading of a sensor: its value, when it was read (s), and its number.
struct Sample {
    std::optional<std::string> value;
    double time = 0.0;
    long number = 0;
};

// A kind, and its parameter: a time (s) or a rate, or the value at which a sensor is stuck.
struct Disturbance {
    std::string kind;
    double number = 0.0;
    std::optional<std::string> value;
};

// `wrong` says which kind or parameter makes no sense.
Disturbance disturbance_of(
    const std::string& kind, const std::map<std::string, Json>& given, std::string& wrong);

class DisturbedSensor {
public:
    // `values` are those of its fact, `seed` decides chance.
    DisturbedSensor(std::vector<std::string> values, std::string seed)
        : values_(std::move(values)), seed_(std::move(seed)) {}

    void begin(const Disturbance& what);  // `none` ends all kinds
    void take(Sample sample, double now);
    std::vector<Sample> release(double now);  // those that arrive now, as they were sent

private:
    struct Kind {
        Disturbance what;
        Chance chance;
        std::optional<double> since;  // of a drift
        bool stuck = false;
    };

    bool pass(Kind& kind, Sample& sample);  // false if the sample is lost

    std::vector<std::string> values_;
    std::string seed_;
    long begun_ = 0;
    double delay_ = 0.0;
    std::map<std::string, Kind> kinds_;
    std::vector<std::pair<double, Sample>> held_;
};

}  // namespace dsfo
