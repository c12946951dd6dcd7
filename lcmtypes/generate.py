#!/usr/bin/env python3
"""Writes what PUCK needs of the message types beside lcm-gen's code, from *.lcm:

  FOLDER/puck/channels.hpp      the channels, the type that each carries, and the arrays in a type
  FOLDER/puck/wire_layouts.hpp  every field as it is encoded, with its range

Usage: generate.py FOLDER FILE.lcm..., in the order of enum Channel. Beside LCM's own grammar:
- The comment above a struct ends in "Channel NAME."
- A field's comment may end in "range [LOW, HIGH]", and must for the count of an array. Otherwise an
  int64 is a time or a count, 0 to kMostOnWire; an int32 is not negative; a session is positive, or 0
  for none in `..._session`; a text has up to 255 bytes; a double is finite.
- Constants PHASE_... that count from 0 name the values of an int8 field `phase`.
"""

import pathlib
import re
import sys

KINDS = {
    "int8_t": "kInt8",
    "boolean": "kBoolean",
    "int32_t": "kInt32",
    "int64_t": "kInt64",
    "double": "kDouble",
    "string": "kString",
    "byte": "kByte",
}
MOST_INT32 = str(2**31 - 1)
MOST_INT64 = str(2**63 - 1)
MOST_TEXT = "255"

FIELD = re.compile(r"(\w+) (\w+)(?:\[(\w+)\])?;(.*)")
CONSTANT = re.compile(r"const int8_t (\w+) = (\d+);")
RANGE = re.compile(r"range \[(.+), (.+)\]$")


class Field:
    def __init__(self, kind, name, count, comment, constants):
        self.kind = kind
        self.name = name
        self.count_field = count if count and not count.isdigit() else ""
        self.fixed_count = count if count and count.isdigit() else "1"
        beginning = name.upper() + "_"
        self.meanings = [constant[len(beginning):].lower().replace("_", " ")
                         for constant in constants
                         if kind == "int8_t" and constant.startswith(beginning)]
        told = RANGE.search(comment.strip())
        self.is_limited = told is not None
        self.low, self.high = self.numbers(told.groups()) if told else self.usual_range()

    @staticmethod
    def numbers(texts):
        for text in texts:
            if not re.fullmatch(r"[-+ \d^]+", text):
                raise ValueError(f"{text} is no number")
        low, high = (eval(text.replace("^", "**")) for text in texts)
        # C++ has no literal for the least int64.
        return (f"{low + 1} - 1" if low == -2**63 else str(low)), str(high)

    def usual_range(self):
        if self.kind == "int8_t":
            return "0", str(len(self.meanings) - 1)
        if self.kind == "int64_t" and self.name == "session":
            return "1", MOST_INT64
        if self.kind == "int64_t" and self.name.endswith("_session"):
            return "0", MOST_INT64
        high = {"boolean": "1", "int32_t": MOST_INT32, "int64_t": "kMostOnWire",
                "string": MOST_TEXT, "byte": "255", "double": "0"}
        return "0", high[self.kind]


class Struct:
    def __init__(self, path):
        text = path.read_text(encoding="utf-8")
        self.type = path.stem
        self.channel = re.search(r"Channel (PUCK_\w+)\.\nstruct " + self.type, text)[1]
        words = self.channel.removeprefix("PUCK_").split("_")
        self.enumerator = "k" + "".join(word.capitalize() for word in words)
        self.fields = []
        constants = []
        for line in map(str.strip, text.split("{", 1)[1].splitlines()):
            if constant := CONSTANT.match(line):
                if int(constant[2]) != sum(c.split("_")[0] == constant[1].split("_")[0]
                                           for c in constants):
                    raise ValueError(f"{constant[1]} does not count from 0")
                constants.append(constant[1])
            elif field := FIELD.match(line):
                self.fields.append(Field(*field.groups(), constants))
            elif line not in ("", "}") and not line.startswith(("//", "const int32_t ")):
                raise ValueError(f"{line} is neither a field nor a constant")
        for count in self.arrays():
            if not next(field for field in self.fields if field.name == count).is_limited:
                raise ValueError(f"{count} counts an array, so its comment must end in a range")

    def arrays(self):
        """The names of the arrays by the field that counts them."""
        arrays = {}
        for field in self.fields:
            if field.count_field:
                arrays.setdefault(field.count_field, []).append(field.name)
        return arrays


def channels(structs):
    yield "#pragma once\n\n#include <array>\n#include <string_view>\n\n"
    for struct in structs:
        yield f'#include "puck/{struct.type}.hpp"\n'
    yield "\nnamespace puck {\n\nenum class Channel {\n"
    for struct in structs:
        yield f"  {struct.enumerator},\n"
    yield "};\n\ninline constexpr std::array kAllChannels{\n"
    for struct in structs:
        yield f"    Channel::{struct.enumerator},\n"
    yield "};\ninline constexpr std::array<std::string_view, kAllChannels.size()> kBaseNames{\n"
    for struct in structs:
        yield f'    "{struct.channel}",\n'
    yield "};\n\ntemplate <typename Message>\n"
    yield "inline constexpr Channel kChannelOf = Message::no_channel_carries_this_type;\n"
    for struct in structs:
        yield f"template <>\ninline constexpr Channel kChannelOf<{struct.type}> ="
        yield f" Channel::{struct.enumerator};\n"
    yield "\ntemplate <typename Use>\nvoid with_message_type(Channel channel, Use&& use) {\n"
    yield "  switch (channel) {\n"
    for struct in structs:
        yield f"    case Channel::{struct.enumerator}:\n      return use({struct.type}{{}});\n"
    yield "  }\n}\n\n"
    for struct in structs:
        arrays = struct.arrays()
        yield f"template <typename Use>\nvoid with_arrays({struct.type}&"
        yield " message, Use use) {\n" if arrays else ", Use) {\n"
        for count, names in arrays.items():
            yield f"  use({', '.join('message.' + name for name in [count, *names])});\n"
        yield "}\n"
    yield "\n}  // namespace puck\n"


def wire_layouts(structs):
    yield "#pragma once\n\nnamespace puck {\n\n"
    for struct in structs:
        for field in struct.fields:
            if field.meanings:
                names = ", ".join(f'"{meaning}"' for meaning in field.meanings)
                yield "constexpr std::array<std::string_view, "
                yield f"{len(field.meanings)}> {struct.enumerator}_{field.name}{{{names}}};\n"
        yield f"constexpr WireField {struct.enumerator}_fields[] = {{\n"
        for field in struct.fields:
            meanings = f"{struct.enumerator}_{field.name}" if field.meanings else "{}"
            yield f'    {{"{field.name}", WireKind::{KINDS[field.kind]}, {field.low}, {field.high}, '
            yield f'"{field.count_field}", {field.fixed_count}, {meanings}}},\n'
        yield "};\n\n"
    yield "constexpr std::array<WireLayout, kAllChannels.size()> kLayouts{{\n"
    for struct in structs:
        yield f'    {{"{struct.type}", &{struct.type}::getHash, {struct.enumerator}_fields}},\n'
    yield "}};\n\n}  // namespace puck\n"


def main(folder, paths):
    structs = []
    for path in map(pathlib.Path, paths):
        try:
            structs.append(Struct(path))
        except (KeyError, TypeError, ValueError) as error:
            sys.exit(f"{path}: {error}")
    folder = pathlib.Path(folder) / "puck"
    folder.mkdir(parents=True, exist_ok=True)
    for name, parts in (("channels", channels), ("wire_layouts", wire_layouts)):
        text = "// Generated from lcmtypes/ by generate.py.\n" + "".join(parts(structs))
        (folder / f"{name}.hpp").write_text(text, encoding="utf-8")


main(sys.argv[1], sys.argv[2:])
