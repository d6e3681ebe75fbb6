"""Greek letters as words, for terminals that cannot show them and for people who type them."""

import codecs
import io
import sys
import unicodedata

SIGNS = {"√": "sqrt", "∞": "inf", "≤": "<=", "≥": ">=", "−": "-", "→": "->", "×": "x", "·": "*"}


def spelled(text: str) -> str:
    """The text in ASCII: α is alpha, ² is 2, what has no such form is a question mark."""
    return "".join(map(_letter, text))


def _letter(letter: str) -> str:
    if letter.isascii():
        return letter
    name = unicodedata.name(letter, "")
    if name.startswith("GREEK") and "LETTER" in name:
        word = name.split("LETTER ")[1].split()[0].lower()
        word = word.replace("lamda", "lambda")
        return word.capitalize() if "CAPITAL" in name else word
    plain = unicodedata.normalize("NFKD", letter).encode("ascii", "ignore").decode()
    return SIGNS.get(letter) or plain or "?"


def symbols(meaning: str) -> list[str]:
    """The symbols in a phrase as words: α of "restitution α" is alpha, a of "shear rate a" is a."""
    words = meaning.translate(str.maketrans(",;:()", " " * 5)).split()
    found = []
    for place, word in enumerate(words):
        letter = word.rstrip("²³*'0123456789")
        article = letter == "a" and place < len(words) - 1
        if len(letter) == 1 and letter.isalpha() and not article:
            found.append(spelled(letter).lower())
    return found


def _replace(error: UnicodeError) -> tuple[str | bytes, int]:
    if not isinstance(error, UnicodeEncodeError):
        raise error
    return spelled(error.object[error.start : error.end]), error.end


def never_fail_to_print() -> None:
    """What a terminal cannot encode is spelled instead of raising UnicodeEncodeError."""
    codecs.register_error("spelled", _replace)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="spelled")
