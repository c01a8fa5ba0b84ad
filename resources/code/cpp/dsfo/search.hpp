// The cheapest way through a graph that is built on demand (A*).
#pragma once

#include <functional>
#include <limits>

#include "steps.hpp"

namespace dsfo {

inline constexpr double nowhere = std::numeric_limits<double>::infinity();

struct Move {
    Configuration to;
    double cost = 0.0;
    int number = 0;  // the number of edges of the routed SB
    std::vector<std::string> names;  // the names of these edges
    std::pair<int, std::string> key;  // decides between moves that are else equal
    const Edge* what = nullptr;
};

struct Found {
    bool any = false;
    bool gave_up = false;
    std::vector<Move> moves;
};

// Ties: cost, number of edges of the routed SB, number of moves, then names, move by move.
// `moves` returns false if the search must be given up.
Found cheapest(
    const Configuration& start, const std::function<bool(const Configuration&)>& is_goal,
    const std::function<bool(const Configuration&, std::vector<Move>&)>& moves, std::size_t most,
    const std::function<double(const Configuration&)>& ahead);

std::size_t patience(const Blueprint& blueprint);

}  // namespace dsfo
