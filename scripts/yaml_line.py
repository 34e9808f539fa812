"""The values of YAML files that stand on one line each and are read without a YAML library."""


def valueOf(text, place):
    """A plain value, or what single quotes hold. Raises ValueError, which begins with `place`, where YAML wants quotes."""
    if text.startswith("'") and text.endswith("'") and len(text) > 1:
        return text[1:-1].replace("''", "'")
    if ": " in text or " #" in text:
        raise ValueError(f"{place}: '{text}' has a colon or a number sign: YAML wants it in single quotes")
    return text
