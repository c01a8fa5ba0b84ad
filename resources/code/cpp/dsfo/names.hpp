// Names of persons and roles: case, space, accents and invisible characters do not matter.
#pragma once

#include <string>
#include <vector>

namespace dsfo {

// The form that all spellings of one name share. `known` is false if a letter is of a script whose
// spellings this program cannot compare: it knows Latin, Greek and Cyrillic letters.
std::string same_name(const std::string& text, bool& known);
std::string same_name(const std::string& text);

// Whether a text has something to read, and nothing that is invisible but plain spaces.
bool is_printable(const std::string& text);

// Whether everyone in `given` gets a seat among the roles `wanted`. An empty role is a seat for
// anybody. The role `escalation` may take any seat.
bool seated(
    const std::vector<std::string>& wanted, const std::vector<std::string>& given,
    const std::string& escalation);

}  // namespace dsfo
