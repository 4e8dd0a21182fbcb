# SPDX-License-Identifier: Apache-2.0
"""Reads TOML and JSON that people write, checked by a pydantic model.

    class Deviation(Table):
        id: Annotated[str, Field(pattern=r"^MD-[0-9]{3}$")]
        reason: Text

    class Deviations(Table):
        deviation: list[Deviation] = []

    read_toml(path, Deviations).deviation

A mistake is a ConfigError, a line for each: specs/x.toml:12: deviation MD-003: reason: missing.
Whoever imports this has pydantic: it is installed when it is missing.
"""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Callable, Iterable
from functools import cache
from pathlib import Path
from typing import Annotated, Any, TypeVar

from keel.base.errors import ROOT, ToolError, nearest
from keel.base.files import read_text
from keel.base.toml_lines import KeyPath, line_index, line_of
from keel.install.packages import provide

provide()

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

__all__ = [
    "ConfigError",
    "Field",
    "Mistake",
    "Table",
    "Text",
    "model_validator",
    "parse_toml",
    "read_json",
    "read_toml",
]

SHOWN = 40  # Characters of what a file holds that an error quotes.


class ConfigError(ToolError):
    """What is wrong with a file, a line for each mistake."""


class Table(BaseModel):
    """A table of a file: no unknown keys, no conversions, and nothing changes it."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)


Text = Annotated[str, Field(min_length=1)]
Model = TypeVar("Model", bound=BaseModel)


Mistake = tuple[KeyPath, str]  # Where in the data, and the reason.
Check = Callable[[Model], Iterable[Mistake]]  # What types cannot say.


def read_toml(path: Path, model: type[Model], check: Check[Model] | None = None) -> Model:
    """The file as the model has it."""
    return parse_toml(read_text(path), model, place_of(path), check)


def parse_toml(
    text: str, model: type[Model], shown: str, check: Check[Model] | None = None
) -> Model:
    """A text as the model has it; `shown` is the file's name in errors."""
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        at = re.search(r"line (\d+)", str(error))
        line = int(at[1]) if at else text.count("\n") + 1
        reason = re.sub(r" \(at .*\)$", "", str(error))
        raise ConfigError(f"{shown}:{line}: no TOML: {reason}") from error
    except (RecursionError, ValueError) as error:
        # What tomllib lets through: deeply nested brackets, numbers of thousands of digits.
        raise ConfigError(f"{shown}:1: no usable TOML") from error
    found = checked(data, model, shown, text)
    if check and (mistakes := list(check(found))):
        raise refusal(data, shown, text, mistakes)
    return found


def read_json(path: Path, model: type[Model]) -> Model:
    """The file as the model has it."""
    shown = place_of(path)
    try:
        # In JSON lists stand for tuples too, and numbers for enumerations.
        return checked(json.loads(read_text(path)), model, shown, strict=False)
    except (json.JSONDecodeError, RecursionError) as error:
        line = getattr(error, "lineno", 1)
        raise ConfigError(f"{shown}:{line}: no JSON: {getattr(error, 'msg', error)}") from error


def place_of(path: Path) -> str:
    """A file's name in an error: from the root if it lies below it."""
    return path.relative_to(ROOT).as_posix() if path.is_relative_to(ROOT) else str(path)


def checked(
    data: Any, model: type[Model], shown: str, text: str = "", strict: bool | None = None
) -> Model:
    """The data as the model has them; `text` is the TOML they come from, for the lines."""
    try:
        return model.model_validate(data, strict=strict)
    except ValidationError as error:
        mistakes = [
            (
                existing(data, entry["loc"]),
                reason_of(entry["type"], entry["msg"], entry["input"], entry["loc"], model),
            )
            for entry in error.errors(include_url=False, include_context=False)
        ]
        raise refusal(data, shown, text, mistakes) from error


def refusal(data: Any, shown: str, text: str, mistakes: Iterable[Mistake]) -> ConfigError:
    """The error that tells mistakes in the order of their lines."""
    lines = line_index(text) if text else {}
    found = []
    for place, reason in mistakes:
        line = line_of(lines, place)
        words = ": ".join([f"{shown}:{line}" if text else shown, *in_words(data, place)])
        found.append((line, f"{words}: {reason}"))
    return ConfigError("\n".join(told for _, told in sorted(found)))


def existing(data: Any, place: KeyPath) -> KeyPath:
    """The part of a place that are keys of the file, and the key that is missing, if one is."""
    for number, part in enumerate(place):
        inside = isinstance(part, int) and isinstance(data, list) and part < len(data)
        if not inside and not (isinstance(data, dict) and part in data):
            return place[: number + 1] if isinstance(data, dict) else place[:number]
        data = data[part]
    return place


def in_words(data: Any, place: KeyPath) -> list[str]:
    """A place as a reader finds it: ["deviation MD-003", "reason"]."""
    words: list[str] = []
    for part in place:
        data = data[part] if isinstance(part, int) or part in data else None
        if isinstance(part, int):
            named = data if isinstance(data, dict) else {}
            name = next((named[key] for key in ("name", "id") if key in named), None)
            own = name if isinstance(name, str) and name.isprintable() else f"number {part + 1}"
            words[-1] = f"{words[-1]} {own[:SHOWN]}"
        else:
            words.append(part[:SHOWN])
    return words


def reason_of(kind: str, message: str, given: Any, place: KeyPath, model: type[BaseModel]) -> str:
    """pydantic's message in our words, with what was there instead."""
    if kind == "missing":
        return "is missing"
    if kind == "extra_forbidden":
        like = nearest(str(place[-1]), sorted(keys_of(model)))
        return f"unknown key; did you mean {like}?" if like else "unknown key"
    if kind == "value_error":
        return message.removeprefix("Value error, ")
    wanted = re.sub(r"^[A-Z]\w+ should", "expected to", message)
    return f"{wanted}, found {quoted(given)}"


@cache
def keys_of(model: type[BaseModel]) -> set[str]:
    """Every key that a model or one within it knows."""
    schema = model.model_json_schema()
    tables = [schema, *schema.get("$defs", {}).values()]
    return {key for table in tables for key in table.get("properties", {})}


def quoted(given: Any) -> str:
    """What was found, in few words."""
    if isinstance(given, dict | list):
        return "a table" if isinstance(given, dict) else "an array"
    if isinstance(given, int) and given.bit_length() > 128:
        return f"a number of {given.bit_length()} bits"
    text = repr(given)
    return text if len(text) <= SHOWN else f"{text[:SHOWN]}..."
