"""Every small edit that a source offers: what could be mutated, and how the switch is written."""
import hashlib
import re

from .cpp_tokens import Lines, isAngle, tokens

PRECEDENCE = {",": 0, "=": 1, "+=": 1, "-=": 1, "*=": 1, "/=": 1, "%=": 1, "&=": 1, "|=": 1, "^=": 1, "<<=": 1, ">>=": 1,
              "?": 2, ":": 2, "||": 3, "&&": 4, "|": 5, "^": 6, "&": 7, "==": 8, "!=": 8, "<": 9, ">": 9, "<=": 9, ">=": 9,
              "<<": 10, ">>": 10, "+": 11, "-": 11, "*": 12, "/": 12, "%": 12}
BINARY = {  # kind, and what stands in place of the operator
    "<": ("compare", ("<=", ">=")), "<=": ("compare", ("<", ">")), ">": ("compare", (">=", "<=")), ">=": ("compare", (">", "<")),
    "==": ("compare", ("!=",)), "!=": ("compare", ("==",)),
    "&&": ("logic", ("||",)), "||": ("logic", ("&&",)),
    "+": ("sign", ("-",)), "-": ("sign", ("+",)), "*": ("arithmetic", ("/",)), "/": ("arithmetic", ("*",)),
    "%": ("arithmetic", ("*",)),
    "&": ("mask", ("|",)), "|": ("mask", ("&",)), "^": ("mask", ("|",)), "<<": ("mask", (">>",)), ">>": ("mask", ("<<",))}
ASSIGNMENTS = {"=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="}
NOT_A_STATEMENT = {"return", "if", "for", "while", "switch", "case", "default", "do", "else", "break", "continue", "using", "auto",
                   "const", "static", "constexpr", "throw", "try", "catch", "goto", "delete", "typedef", "template", "struct",
                   "class", "enum", "unsigned", "signed", "int", "bool", "double", "float", "char", "void", "long", "short",
                   "thread_local", "static_assert", "assert", "public", "private", "protected", "friend", "explicit"}
UNEVALUATED = {"static_assert", "sizeof", "decltype", "alignas", "noexcept", "assert", "alignof"}
STOPS_BEFORE = {"return", "case", "throw", "else", "do", "co_return", "goto", "new", "operator"}


class Edit:
    """One edit: `original` from `start` to `end` becomes `mutated`. `key` says it without line numbers."""

    def __init__(self, path, kind, start, end, original, mutated, what, form):
        self.path, self.kind, self.start, self.end = path, kind, start, end
        self.original, self.mutated, self.what, self.form = original, mutated, what, form
        self.line, self.code, self.key, self.id = 0, "", "", ""
        self.occurrence = 1  # of the same edit of the same line

    def inWords(self):
        """What it replaces by what, on one line."""
        return f"{' '.join(self.original.split())}  ->  {' '.join(self.mutated.split()) or '(nothing)'}"


def editsOf(path, text):
    """All edits of one source, in order of place."""
    found = _Finder(path, text).all()
    lines, seen = Lines(text), {}
    for edit in found:
        edit.line, edit.code = lines.number(edit.start), lines.line(edit.start)
        same = (path, edit.code, edit.what)
        seen[same] = seen.get(same, 0) + 1
        edit.occurrence = seen[same]
        edit.key = "|".join([path, edit.code, edit.what, str(edit.occurrence)])
        edit.id = hashlib.sha1(edit.key.encode()).hexdigest()[:6]
    return found


class _Finder:
    def __init__(self, path, text):
        self._path, self._text, self._tokens = path, text, tokens(text)
        self._skip = self._unevaluated()

    def all(self):
        found = []
        for i, token in enumerate(self._tokens):
            if i in self._skip:
                continue
            if token.scope.inFunction():
                found += self._operator(i) + self._not(i) + self._return(i) + self._statement(i)
            found += self._number(i) + self._truth(i)
        return found

    def _unevaluated(self):
        """Indices of tokens that are no expression evaluated at run time."""
        skipped = set()
        for i, token in enumerate(self._tokens):
            if token.scope.kind == "enum":
                skipped.add(i)
            elif token.text in UNEVALUATED and self._next(i) == "(":
                skipped.update(range(i, self._tokens[i + 1].partner or i))
            elif token.text == "constexpr" and token.scope.inFunction() and self._tokens[i - 1].text == "if":
                skipped.update(range(i, self._tokens[i + 1].partner or i))
            elif token.text == "constexpr" and token.scope.inFunction():
                skipped.update(range(i, self._endOfStatement(i)))
            elif token.text == "case" or (token.text == "template" and self._next(i) == "<"):
                end = i
                while end < len(self._tokens) and self._tokens[end].text not in ((":",) if token.text == "case" else (">",)):
                    end += 1
                skipped.update(range(i, end + 1))
            elif isAngle(self._tokens, i) and token.text == "<" and token.partner:
                skipped.update(range(i, token.partner))
        return skipped

    def _next(self, i):
        return self._tokens[i + 1].text if i + 1 < len(self._tokens) else ""

    def _endOfStatement(self, i):
        parens, scope = self._tokens[i].parens, self._tokens[i].scope
        while i < len(self._tokens):
            token = self._tokens[i]
            if token.text == ";" and token.scope is scope and token.parens == parens:
                return i
            if token.scope is scope and token.parens < parens:
                return i
            i += 1
        return i

    # --- expressions --------------------------------------------------------------------------------------------------

    def _binary(self, i):
        token = self._tokens[i]
        if token.kind != "op" or token.text not in PRECEDENCE or token.text in (",", "?", ":"):
            return False
        return token.spaced and not isAngle(self._tokens, i)

    def _operator(self, i):
        token = self._tokens[i]
        if token.text not in BINARY or not self._binary(i):
            return []
        first, last = self._left(i, PRECEDENCE[token.text]), self._right(i, PRECEDENCE[token.text])
        if first is None or last is None:
            return []
        start, end = self._tokens[first].start, self._tokens[last].end
        left, right = self._text[start:token.start], self._text[token.end:end]
        if token.text in ("+", "<<") and '"' in left + right:
            return []
        if token.text == "-" and left.strip() == "now":  # two times of the clock have no sum
            return []
        kind, others = BINARY[token.text]
        return [Edit(self._path, kind, start, end, self._text[start:end], left + other + right,
                     f"{token.text} -> {other}", self._form(token)) for other in others]

    def _left(self, i, precedence):
        first, scope = None, self._tokens[i].scope
        i -= 1
        while i >= 0:
            token = self._tokens[i]
            if token.text in (")", "]", "}") or (token.text == ">" and isAngle(self._tokens, i)):
                if token.partner is None:
                    return None
                if token.text == "}" and token.scope.inFunction() and getattr(self._tokens[token.partner], "opens", "") != "list":
                    break
                if token.text == ")" and self._tokens[token.partner - 1].text in ("if", "while", "for", "switch"):
                    break
                i = first = token.partner
                i -= 1
                continue
            if token.text in ("(", "[", "{", ";") or token.text in STOPS_BEFORE:
                break
            if token.text in (",", "?") or (token.text == ":") or (self._binary(i) and PRECEDENCE[token.text] < precedence):
                break
            first = i
            i -= 1
        return first

    def _right(self, i, precedence):
        last = None
        i += 1
        while i < len(self._tokens):
            token = self._tokens[i]
            if token.text in ("(", "[", "{") or (token.text == "<" and isAngle(self._tokens, i)):
                if token.partner is None:
                    return None
                i = last = token.partner
                i += 1
                continue
            if token.text in (")", "]", "}", ";", ",", "?", ":"):
                break
            if self._binary(i) and PRECEDENCE[token.text] <= precedence:
                break
            last = i
            i += 1
        return last

    def _not(self, i):
        """! and ~ and a minus sign left out."""
        token = self._tokens[i]
        unary_minus = token.text == "-" and not token.spaced and self._prefix(i)
        if token.text not in ("!", "~") and not unary_minus:
            return []
        last = self._right(i, 13)
        if last is None:
            return []
        operand = self._text[token.end:self._tokens[last].end]
        if re.match(r"[\d.]+$", operand.strip()) and float(operand) == 0:
            return []
        mutated = f"bool({operand})" if token.text == "!" else operand
        kind = {"!": "logic", "~": "mask", "-": "sign"}[token.text]
        return [Edit(self._path, kind, token.start, self._tokens[last].end, token.text + operand, mutated,
                     f"{token.text} dropped", self._form(token))]

    def _prefix(self, i):
        before = self._tokens[i - 1]
        return before.text in ("(", ",", "return", "{", "[", "?", ":", ";") or (before.kind == "op" and self._binary(i - 1))

    def _form(self, token):
        return "constexpr" if token.scope.is_constexpr else "value"

    # --- statements ---------------------------------------------------------------------------------------------------

    def _behindIf(self, i):
        """Whether the token before i closes the parenthesis of an `if`."""
        before = self._tokens[i - 1]
        if before.text != ")" or before.partner is None:
            return False
        return self._tokens[before.partner - 1].text == "if"

    def _return(self, i):
        """`return` behind an `if`, alone or as the last statement of its block."""
        token = self._tokens[i]
        if token.text not in ("return", "break", "continue") or token.parens or token.scope.kind not in ("block", "function"):
            return []
        end = self._endOfStatement(i)
        if end >= len(self._tokens):
            return []
        in_block = token.scope.kind == "block" and token.scope.head[:1] == ["if"] and self._next(end) == "}" and \
            token.scope.head[1:3] == ["(", ")"] or token.scope.head[1:3] == [")", "("]
        if not self._behindIf(i) and not (in_block and self._next(end + 1) != "else"):
            return []
        if self._next(end) == "else":
            return []
        start, stop = token.start, self._tokens[end].end
        return [Edit(self._path, "return", start, stop, self._text[start:stop], "", "dropped", "statement" + self._variant(token))]

    def _variant(self, token):
        return "_constexpr" if token.scope.is_constexpr else ""

    def _statement(self, i):
        token = self._tokens[i]
        if token.parens or token.scope.kind not in ("block", "function"):
            return []
        before = self._tokens[i - 1]
        starts = before.text in (";", "{", "}", "else", "do") or \
            (before.text == ")" and before.partner and self._tokens[before.partner - 1].text in ("if", "for", "while"))
        if not starts or token.text in NOT_A_STATEMENT or (token.kind != "name" and token.text not in ("++", "--", "*")):
            return []
        end = self._endOfStatement(i)
        if end >= len(self._tokens) or not self._isAction(i, end):
            return []
        start, stop = token.start, self._tokens[end].end
        return [Edit(self._path, "statement", start, stop, self._text[start:stop], "", "dropped",
                     "statement" + self._variant(token))]

    def _isAction(self, i, end):
        """A call or an assignment, no declaration."""
        assigned = False
        k = i
        while k < end:
            token = self._tokens[k]
            if token.partner and token.partner > k:
                k = token.partner + 1
                if k < end and self._tokens[k].kind == "name":
                    return False
                continue
            if token.text in ASSIGNMENTS or token.text in ("++", "--"):
                assigned = True
                break
            follows = self._tokens[k + 1]
            if token.kind == "name" and follows.kind == "name":
                return False
            if token.text in ("&", "*", "&&", "...") and k > i and not token.spaced:
                return False
            if token.text in ("{", "?"):
                return False
            k += 1
        return assigned or self._tokens[end - 1].text == ")"

    # --- literals -----------------------------------------------------------------------------------------------------

    def _number(self, i):
        token = self._tokens[i]
        if token.kind != "number" or self._tokens[i - 1].text == "[":
            return []
        place = self._literalPlace(i)
        if not place:
            return []
        other = _otherNumber(token.text)
        if other is None:
            return []
        what = f"{token.text} -> {other}"
        kind, form = place
        if token.text.lower().startswith("0x"):
            kind = "mask" if kind == "step" else kind
        return [Edit(self._path, kind, token.start, token.end, token.text, other, what, form)]

    def _truth(self, i):
        token = self._tokens[i]
        if token.text not in ("true", "false"):
            return []
        place = self._literalPlace(i)
        other = "false" if token.text == "true" else "true"
        return [Edit(self._path, "member" if place[0] == "member" else "logic", token.start, token.end, token.text, other,
                     f"{token.text} -> {other}", place[1])] if place else []

    def _literalPlace(self, i):
        """(kind, form) of a literal at this place, None where it is none of an initialiser or an expression."""
        token = self._tokens[i]
        if token.scope.inFunction():
            return "step", self._form(token)
        statement = self._wholeStatement(i)
        words = [self._tokens[k].text for k in statement]
        if "=" not in words[:words.index(token.text) if token.text in words else 0] and token.scope.kind != "list":
            return None
        if "template" in words or "operator" in words:
            return None
        inner = token.scope
        while inner.kind == "list":
            inner = inner.parent
        if inner.kind == "class":
            return None if "constexpr" in words else ("member", "constexpr")
        if "constexpr" in words and token.scope.kind != "list":
            return "step", "constant"
        return None

    def _wholeStatement(self, i):
        first = i
        while first > 0 and self._tokens[first - 1].text not in (";", "{", "}"):
            first -= 1
        return range(first, i + 1)


def _otherNumber(text):
    match = re.fullmatch(r"(0[xX])([0-9a-fA-F']+)([uUlL]*)", text)
    if match:
        digits = match.group(2).replace("'", "")
        value = int(digits, 16)
        lowest = value & -value if value else 1
        return f"{match.group(1)}{value ^ lowest:0{len(digits)}X}{match.group(3)}"
    match = re.fullmatch(r"([\d']+)([A-Za-z]\w*)?", text)
    if match:
        return f"{int(match.group(1).replace(chr(39), '')) + 1}{match.group(2) or ''}"
    match = re.fullmatch(r"(\d*\.\d*(?:[eE][+-]?\d+)?)(\w*)", text)
    if match:
        value = float(match.group(1))
        return f"{_withPoint(value * 1.5 if value else 1.0)}{match.group(2)}"
    return None


def _withPoint(value):
    text = f"{value:.12g}"
    return text if re.search(r"[.e]", text) else text + ".0"
