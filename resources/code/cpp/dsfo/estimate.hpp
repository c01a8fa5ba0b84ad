// A lower bound of the cost that is left, so that a search does not walk where nothing leads on.
//
// Each SB with a goal is looked at alone, in its own graph. An edge that turns the digit of a sub-SB
// costs at least what the cheapest crossing of this sub-SB costs.
#pragma once

#include "search.hpp"

namespace dsfo {

class Estimate {
public:
    Estimate(
        const Stepper& stepper, const std::vector<Goal>& wanted, const std::vector<int>& movers);

    double operator()(const Configuration& node) const;

private:
    std::vector<double> far(int branch, int goal);
    double least(const Edge& edge);
    double turn(int sub, bool up);

    const Stepper& stepper_;
    std::set<int> loaded_;
    std::map<std::pair<int, bool>, double> turns_;
    std::vector<std::pair<int, std::vector<double>>> parts_;
};

}  // namespace dsfo
