#include "chance.hpp"

#include <algorithm>

namespace dsfo {

namespace {

constexpr std::uint64_t rounds[] = {
    0x428a2f98d728ae22, 0x7137449123ef65cd, 0xb5c0fbcfec4d3b2f, 0xe9b5dba58189dbbc,
    0x3956c25bf348b538, 0x59f111f1b605d019, 0x923f82a4af194f9b, 0xab1c5ed5da6d8118,
    0xd807aa98a3030242, 0x12835b0145706fbe, 0x243185be4ee4b28c, 0x550c7dc3d5ffb4e2,
    0x72be5d74f27b896f, 0x80deb1fe3b1696b1, 0x9bdc06a725c71235, 0xc19bf174cf692694,
    0xe49b69c19ef14ad2, 0xefbe4786384f25e3, 0x0fc19dc68b8cd5b5, 0x240ca1cc77ac9c65,
    0x2de92c6f592b0275, 0x4a7484aa6ea6e483, 0x5cb0a9dcbd41fbd4, 0x76f988da831153b5,
    0x983e5152ee66dfab, 0xa831c66d2db43210, 0xb00327c898fb213f, 0xbf597fc7beef0ee4,
    0xc6e00bf33da88fc2, 0xd5a79147930aa725, 0x06ca6351e003826f, 0x142929670a0e6e70,
    0x27b70a8546d22ffc, 0x2e1b21385c26c926, 0x4d2c6dfc5ac42aed, 0x53380d139d95b3df,
    0x650a73548baf63de, 0x766a0abb3c77b2a8, 0x81c2c92e47edaee6, 0x92722c851482353b,
    0xa2bfe8a14cf10364, 0xa81a664bbc423001, 0xc24b8b70d0f89791, 0xc76c51a30654be30,
    0xd192e819d6ef5218, 0xd69906245565a910, 0xf40e35855771202a, 0x106aa07032bbd1b8,
    0x19a4c116b8d2d0c8, 0x1e376c085141ab53, 0x2748774cdf8eeb99, 0x34b0bcb5e19b48a8,
    0x391c0cb3c5c95a63, 0x4ed8aa4ae3418acb, 0x5b9cca4f7763e373, 0x682e6ff3d6b2b8a3,
    0x748f82ee5defb2fc, 0x78a5636f43172f60, 0x84c87814a1f0ab72, 0x8cc702081a6439ec,
    0x90befffa23631e28, 0xa4506cebde82bde9, 0xbef9a3f7b2c67915, 0xc67178f2e372532b,
    0xca273eceea26619c, 0xd186b8c721c0c207, 0xeada7dd6cde0eb1e, 0xf57d4f7fee6ed178,
    0x06f067aa72176fba, 0x0a637dc5a2c898a6, 0x113f9804bef90dae, 0x1b710b35131c471b,
    0x28db77f523047d84, 0x32caab7b40c72493, 0x3c9ebe0a15c9bebc, 0x431d67c49c100d4c,
    0x4cc5d4becb3e42b6, 0x597f299cfc657e2a, 0x5fcb6fab3ad6faec, 0x6c44198c4a475817};

std::uint64_t turned(std::uint64_t word, int by) { return (word >> by) | (word << (64 - by)); }

using Hash = std::array<std::uint64_t, 8>;

void mix(Hash& hash, const std::string& bytes, std::size_t from) {
    std::array<std::uint64_t, 80> words{};
    for (std::size_t at = 0; at < 128; ++at) {
        words[at / 8] = (words[at / 8] << 8) | static_cast<unsigned char>(bytes[from + at]);
    }
    for (std::size_t at = 16; at < 80; ++at) {
        const std::uint64_t one = words[at - 15];
        const std::uint64_t two = words[at - 2];
        words[at] = words[at - 16] + words[at - 7] +
                    (turned(one, 1) ^ turned(one, 8) ^ (one >> 7)) +
                    (turned(two, 19) ^ turned(two, 61) ^ (two >> 6));
    }
    Hash own = hash;
    for (std::size_t at = 0; at < 80; ++at) {
        auto& [a, b, c, d, e, f, g, h] = own;
        const std::uint64_t first = h + (turned(e, 14) ^ turned(e, 18) ^ turned(e, 41)) +
                                    ((e & f) ^ (~e & g)) + rounds[at] + words[at];
        const std::uint64_t second =
            (turned(a, 28) ^ turned(a, 34) ^ turned(a, 39)) + ((a & b) ^ (a & c) ^ (b & c));
        own = Hash{first + second, a, b, c, d + first, e, f, g};
    }
    for (std::size_t at = 0; at < hash.size(); ++at) {
        hash[at] += own[at];
    }
}

// SHA-512 (FIPS 180-4) of a text, as 64 bytes.
std::string sha512(const std::string& text) {
    Hash hash{0x6a09e667f3bcc908, 0xbb67ae8584caa73b, 0x3c6ef372fe94f82b, 0xa54ff53a5f1d36f1,
              0x510e527fade682d1, 0x9b05688c2b3e6c1f, 0x1f83d9abfb41bd6b, 0x5be0cd19137e2179};
    std::string padded = text + '\x80';
    padded.append((240 - padded.size() % 128) % 128, '\0');
    padded.append(8, '\0');
    for (int shift = 56; shift >= 0; shift -= 8) {
        padded += static_cast<char>((static_cast<std::uint64_t>(text.size()) * 8) >> shift);
    }
    for (std::size_t from = 0; from < padded.size(); from += 128) {
        mix(hash, padded, from);
    }
    std::string found;
    for (const std::uint64_t word : hash) {
        for (int shift = 56; shift >= 0; shift -= 8) {
            found += static_cast<char>(word >> shift);
        }
    }
    return found;
}

// A text and its SHA-512 as one number, in words of 32 bits, the smallest first.
std::vector<std::uint32_t> key_of(const std::string& seed) {
    const std::string bytes = seed + sha512(seed);
    std::vector<std::uint32_t> found;
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        const auto byte = static_cast<unsigned char>(bytes[bytes.size() - 1 - at]);
        if (at % 4 == 0) {
            found.push_back(0);
        }
        found.back() |= static_cast<std::uint32_t>(byte) << (8 * (at % 4));
    }
    while (found.size() > 1 && found.back() == 0) {
        found.pop_back();
    }
    return found;
}

}  // namespace

Chance::Chance(const std::string& seed) {
    const std::vector<std::uint32_t> key = key_of(seed);
    state_[0] = 19650218;
    for (std::size_t at = 1; at < size; ++at) {
        state_[at] = 1812433253U * (state_[at - 1] ^ (state_[at - 1] >> 30)) +
                     static_cast<std::uint32_t>(at);
    }
    std::size_t at = 1;
    std::size_t of = 0;
    const auto step = [&] {
        if (++at >= size) {
            state_[0] = state_[size - 1];
            at = 1;
        }
    };
    for (std::size_t left = std::max(size, key.size()); left > 0; --left) {
        const std::uint32_t before = state_[at - 1] ^ (state_[at - 1] >> 30);
        state_[at] = (state_[at] ^ (before * 1664525U)) + key[of] + static_cast<std::uint32_t>(of);
        step();
        of = (of + 1) % key.size();
    }
    for (std::size_t left = size - 1; left > 0; --left) {
        const std::uint32_t before = state_[at - 1] ^ (state_[at - 1] >> 30);
        state_[at] = (state_[at] ^ (before * 1566083941U)) - static_cast<std::uint32_t>(at);
        step();
    }
    state_[0] = 0x80000000U;
}

void Chance::turn() {
    for (std::size_t at = 0; at < size; ++at) {
        const std::uint32_t joined =
            (state_[at] & 0x80000000U) | (state_[(at + 1) % size] & 0x7fffffffU);
        state_[at] =
            state_[(at + 397) % size] ^ (joined >> 1) ^ ((joined & 1U) != 0 ? 0x9908b0dfU : 0U);
    }
    at_ = 0;
}

std::uint32_t Chance::next() {
    if (at_ == size) {
        turn();
    }
    std::uint32_t found = state_[at_++];
    found ^= found >> 11;
    found ^= (found << 7) & 0x9d2c5680U;
    found ^= (found << 15) & 0xefc60000U;
    return found ^ (found >> 18);
}

double Chance::part() {
    const auto high = static_cast<double>(next() >> 5);
    const auto low = static_cast<double>(next() >> 6);
    return (high * 67108864.0 + low) / 9007199254740992.0;
}

std::size_t Chance::below(std::size_t count) {
    int bits = 0;
    while ((count >> bits) != 0) {
        ++bits;
    }
    std::size_t found = count;
    while (found >= count) {
        found = next() >> (32 - bits);
    }
    return found;
}

}  // namespace dsfo
