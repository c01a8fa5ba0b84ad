// JSON, SHA-256, and the log of a run: JSON Lines, each with the SHA-256 of all bytes before it.
#pragma once

#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace dsfo {

class Sha256 {
public:
    void add(const std::string& bytes);
    std::string hex() const;  // of all bytes so far, as 64 hexadecimal digits

private:
    void block(const unsigned char* bytes);

    std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                        0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
    std::string rest_;
    std::uint64_t length_ = 0;
};

std::string json_text(const std::string& text);  // with its quotes, in ASCII
std::string json_number(double number);  // rounded to six decimals
std::string plain_number(double number);  // in six significant digits, such as 2.5 or 20
std::string json_list(const std::vector<std::string>& texts);
std::string json_map(const std::vector<std::pair<std::string, std::string>>& texts);

// A JSON object while it is written.
class Object {
public:
    Object& text(const std::string& name, const std::string& value);
    Object& number(const std::string& name, double value);
    Object& count(const std::string& name, long value);
    Object& raw(const std::string& name, const std::string& json);
    std::string str() const { return "{" + members_ + "}"; }

private:
    std::string members_;
};

// A log that is being written. The file must be new or empty.
class RunLog {
public:
    // `failed` says why it cannot be written.
    RunLog(const std::string& path, const std::string& header, std::string& failed);

    void write(const std::string& event);  // a JSON object
    void finish();  // the head: the number of events, and the SHA-256 of all bytes before
    bool good() const { return file_.good(); }

private:
    void linked(const std::string& line);

    std::ofstream file_;
    Sha256 hash_;
    long count_ = 0;
};

std::string now();  // the wall time, as the header of a log has it

}  // namespace dsfo
