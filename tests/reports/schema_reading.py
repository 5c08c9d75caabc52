"""Whether a document fits a JSON Schema."""

from __future__ import annotations

from typing import Any


def fits(schema: dict[str, Any], data: Any, definitions: dict[str, Any]) -> bool:
    """A small reading of JSON Schema, enough for the schema at hand."""
    if "$ref" in schema:
        return fits(definitions[schema["$ref"].rpartition("/")[2]], data, definitions)
    if "anyOf" in schema:
        return any(fits(option, data, definitions) for option in schema["anyOf"])
    kinds = schema.get("type", [])
    names: dict[str, type | tuple[type, ...]] = {
        "object": dict,
        "array": list,
        "string": str,
        "integer": int,
        "number": (int, float),
        "boolean": bool,
        "null": type(None),
    }
    allowed = [names[kind] for kind in ([kinds] if isinstance(kinds, str) else kinds)]
    if allowed and not isinstance(data, tuple(allowed)):
        return False
    if isinstance(data, dict):
        if not set(schema.get("required", ())) <= set(data):
            return False
        properties = schema.get("properties", {})
        return all(
            fits(properties[key], value, definitions)
            for key, value in data.items()
            if key in properties
        )
    if isinstance(data, list) and "items" in schema:
        return all(fits(schema["items"], item, definitions) for item in data)
    return True
