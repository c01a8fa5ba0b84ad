#include "estimate.hpp"

#include <algorithm>
#include <queue>

namespace dsfo {

namespace {

std::size_t index(int number) { return static_cast<std::size_t>(number); }

}  // namespace

Estimate::Estimate(
    const Stepper& stepper, const std::vector<Goal>& wanted, const std::vector<int>& movers)
    : stepper_(stepper) {
    for (const int one : movers) {
        const auto& operations = stepper.hierarchy.of(one).operations;
        if (std::any_of(operations.begin(), operations.end(), [](const auto& pair) {
                return pair.second.load;
            })) {
            for (const int sub : stepper.hierarchy.tree(one)) {
                if (sub != one) {
                    loaded_.insert(sub);
                }
            }
        }
    }
    for (const auto& [branch, state] : wanted) {
        const bool moves = std::find(movers.begin(), movers.end(), branch) != movers.end();
        if (moves && loaded_.count(branch) == 0) {
            parts_.emplace_back(branch, far(branch, state));
        }
    }
}

double Estimate::operator()(const Configuration& node) const {
    double most = 0.0;
    for (const auto& [branch, costs] : parts_) {
        most = std::max(most, costs[index(node[index(branch)])]);
    }
    return most;
}

std::vector<double> Estimate::far(int branch, int goal) {
    const std::size_t count = stepper_.hierarchy.of(branch).states.size();
    std::vector<std::vector<std::pair<int, double>>> into(count);
    for (std::size_t state = 0; state < count; ++state) {
        for (const Edge& edge : stepper_.edges.out(branch, static_cast<int>(state))) {
            into[index(edge.target)].emplace_back(edge.source, least(edge));
        }
    }
    std::vector<double> found(count, nowhere);
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> heap;
    found[index(goal)] = 0.0;
    heap.emplace(0.0, goal);
    while (!heap.empty()) {
        const auto [cost, state] = heap.top();
        heap.pop();
        if (cost > found[index(state)]) {
            continue;
        }
        for (const auto& [source, more] : into[index(state)]) {
            const double further = more == nowhere ? nowhere : rounded(cost + more);
            if (further < found[index(source)]) {
                found[index(source)] = further;
                heap.emplace(further, source);
            }
        }
    }
    return found;
}

double Estimate::least(const Edge& edge) {
    if (!stepper_.closures(edge).empty()) {
        return nowhere;
    }
    std::set<std::pair<int, bool>> turned;
    for (const int digit : edge.rises) {
        turned.emplace(stepper_.hierarchy.sub_at(edge.branch, digit), true);
    }
    for (const int digit : edge.falls) {
        turned.emplace(stepper_.hierarchy.sub_at(edge.branch, digit), false);
    }
    double found = edge.cost;
    for (const auto& [sub, up] : turned) {
        found += turn(sub, up);
    }
    return found;
}

double Estimate::turn(int sub, bool up) {
    if (loaded_.count(sub)) {
        return 0.0;
    }
    const auto known = turns_.find({sub, up});
    if (known != turns_.end()) {
        return known->second;
    }
    double found = nowhere;
    const std::size_t count = stepper_.hierarchy.of(sub).states.size();
    for (std::size_t state = 0; state < count; ++state) {
        for (const Edge& edge : stepper_.edges.out(sub, static_cast<int>(state))) {
            if (edge.crossing == (up ? 1 : -1)) {
                found = std::min(found, least(edge));
            }
        }
    }
    turns_[{sub, up}] = found;
    return found;
}

}  // namespace dsfo
