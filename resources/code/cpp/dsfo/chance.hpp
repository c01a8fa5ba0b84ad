// Chance from a text: the same numbers as `random.Random(text)` of Python gives, so that equal seeds
// disturb sensors alike in Studio and here (Mersenne Twister, seeded by SHA-512).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dsfo {

class Chance {
public:
    explicit Chance(const std::string& seed);

    double part();  // from 0 up to 1
    std::size_t below(std::size_t count);

private:
    static constexpr std::size_t size = 624;

    std::uint32_t next();
    void turn();

    std::array<std::uint32_t, size> state_{};
    std::size_t at_ = size;
};

}  // namespace dsfo
