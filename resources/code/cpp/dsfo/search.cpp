#include "search.hpp"

#include <algorithm>
#include <queue>
#include <tuple>

namespace dsfo {

namespace {

using Rank = std::tuple<double, int, int>;
using Origin = std::pair<Configuration, Move>;
using Origins = std::map<Configuration, std::vector<Origin>>;

std::vector<Move> first_by_name(
    const Configuration& start, const std::vector<Configuration>& goals, const Origins& origins) {
    std::map<Configuration, std::vector<Move>> onward;
    std::set<Configuration> seen(goals.begin(), goals.end());
    std::vector<Configuration> waiting = goals;
    while (!waiting.empty()) {
        const Configuration node = waiting.back();
        waiting.pop_back();
        for (const auto& [origin, move] : origins.at(node)) {
            onward[origin].push_back(move);
            if (seen.insert(origin).second) {
                waiting.push_back(origin);
            }
        }
    }
    std::vector<Move> route;
    Configuration node = start;
    for (auto ways = onward.find(node); ways != onward.end(); ways = onward.find(node)) {
        const auto least = std::min_element(
            ways->second.begin(), ways->second.end(), [](const Move& one, const Move& other) {
                return std::tie(one.names, one.key) < std::tie(other.names, other.key);
            });
        route.push_back(*least);
        node = least->to;
    }
    return route;
}

}  // namespace

Found cheapest(
    const Configuration& start, const std::function<bool(const Configuration&)>& is_goal,
    const std::function<bool(const Configuration&, std::vector<Move>&)>& moves, std::size_t most,
    const std::function<double(const Configuration&)>& ahead) {
    using Entry = std::tuple<Rank, std::size_t, Rank, Configuration>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> heap;
    std::map<Configuration, Rank> best{{start, Rank{0.0, 0, 0}}};
    Origins origins{{start, {}}};
    std::vector<Configuration> goals;
    std::optional<Rank> reached;
    std::size_t order = 0;
    std::size_t looked_at = 0;
    Found found;
    if (ahead(start) < nowhere) {
        heap.emplace(Rank{ahead(start), 0, 0}, order++, Rank{0.0, 0, 0}, start);
    }
    while (!heap.empty()) {
        const auto [hoped, number, rank, node] = heap.top();
        (void)number;
        heap.pop();
        if (rank != best[node]) {
            continue;
        }
        if (reached && hoped > *reached) {
            break;
        }
        if (is_goal(node)) {
            goals.push_back(node);
            reached = hoped;
            continue;
        }
        std::vector<Move> onward;
        if (++looked_at > most || !moves(node, onward)) {
            found.gave_up = true;
            return found;
        }
        for (const Move& move : onward) {
            const Rank further{
                rounded(std::get<0>(rank) + move.cost), std::get<1>(rank) + move.number,
                std::get<2>(rank) + 1};
            const auto known = best.find(move.to);
            if (known != best.end() && further == known->second) {
                origins[move.to].emplace_back(node, move);
                continue;
            }
            if (known != best.end() && further > known->second) {
                continue;
            }
            const double left = ahead(move.to);
            if (left == nowhere) {
                continue;
            }
            best[move.to] = further;
            origins[move.to] = {{node, move}};
            const Rank hope{
                rounded(std::get<0>(further) + left), std::get<1>(further), std::get<2>(further)};
            heap.emplace(hope, order++, further, move.to);
        }
    }
    found.any = !goals.empty();
    if (found.any) {
        found.moves = first_by_name(start, goals, origins);
    }
    return found;
}

std::size_t patience(const Blueprint& blueprint) {
    std::size_t states = 0;
    for (const Branch& branch : blueprint.branches) {
        states += branch.states.size();
    }
    return 50000 + 4 * states;
}

}  // namespace dsfo
