#include "record.hpp"

#include <array>
#include <fstream>

#include "log.hpp"

namespace dsfo {

namespace {

// The SHA-256 of a file, empty if it cannot be read.
std::string digest_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::array<char, 4096> bytes{};
    Sha256 hash;
    bool some = false;
    while (file.read(bytes.data(), bytes.size()) || file.gcount() > 0) {
        hash.add(std::string(bytes.data(), static_cast<std::size_t>(file.gcount())));
        some = true;
    }
    return some && !file.bad() ? hash.hex() : "";
}

std::string compared(
    const std::string& path, const std::string& digest, const std::string& what) {
    const std::string found = digest_of(path);
    if (found.empty()) {
        return path + " cannot be read, or is empty";
    }
    return found == digest ? ""
                           : path + " is not the " + what + " of this program: its SHA-256 is " +
                                 found + ", not " + digest;
}

}  // namespace

std::string start_refused(
    const Blueprint& blueprint, const std::string& record, const std::string& file) {
    if (blueprint.record.empty() && !record.empty()) {
        return "this program was generated without an inspection record, so none approves it";
    }
    if (!blueprint.record.empty() && record.empty()) {
        return "this program starts only with its inspection record: say --record FILE";
    }
    const std::string no =
        record.empty() ? "" : compared(record, blueprint.record, "inspection record");
    return !no.empty() || file.empty() ? no : compared(file, blueprint.file, "blueprint");
}

}  // namespace dsfo
