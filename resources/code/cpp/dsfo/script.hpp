// Scripts: what a supervisor does, operations that people choose, and faults, at their moments.
//
// A script is JSON Lines. Every line is checked before the run begins. Keys that begin with an
// underscore are comments.
#pragma once

#include "commands.hpp"

namespace dsfo {

enum class Moment { at, when, during, asked };

// One line of a script: its moment, its word, its arguments, and who acts. `seconds` is the time of
// `at`, and what is waited after the others. `times` 0 means every time. `turn` counts ticks, because
// several may have one simulated time.
struct Act {
    long line = 0;
    Command command;
    Moment moment = Moment::at;
    double seconds = 0.0;
    std::string address;
    long times = 1;
    long turn = 1;

    std::string words() const;
};

struct Script {
    std::string file;
    std::vector<Act> acts;
    std::map<std::string, std::string> levels;  // set before the start
    std::string digest;  // SHA-256 of the file
};

// `wrong` has the file and the line of what is wrong.
Script read_script(const std::string& path, const Hierarchy& hierarchy, std::string& wrong);

}  // namespace dsfo
