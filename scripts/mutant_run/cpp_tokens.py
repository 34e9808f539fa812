"""C++ source as tokens that know the brackets around them: as much of the language as clang-format leaves unambiguous.

clang-format sets a binary operator between spaces and nothing around the brackets of a template, so `a < b` and
`vector<int>` differ in their spaces. A wrong guess costs a mutant at most: the compiler refuses it, and it is dropped aloud.
"""
import bisect
import re

TOKEN = re.compile(r"""
    (?P<comment>//[^\n]*|/\*.*?\*/)
  | (?P<directive>^[ \t]*\#(?:[^\n\\]|\\.|\\\n)*)
  | (?P<string>(?:u8|u|U|L)?R"(?P<raw>[^(\s]*)\(.*?\)(?P=raw)"|(?:u8|u|U|L)?"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)+')
  | (?P<number>0[xX][0-9a-fA-F']+\w*|(?:\d[\d']*\.?[\d']*|\.\d+)(?:[eE][+-]?\d+)?\w*)
  | (?P<name>[A-Za-z_]\w*)
  | (?P<op>->\*|<<=|>>=|\.\.\.|::|->|\+\+|--|\+=|-=|\*=|/=|%=|&=|\|=|\^=|==|!=|<=|>=|&&|\|\||<<|>>|[-+*/%&|^~!=<>?:;,.(){}\[\]])
""", re.X | re.S | re.M)

OPEN = {"(": ")", "[": "]", "{": "}"}


class Token:
    """One token. `scope` is the innermost brace around it, `parens` how many ( and [ are open inside that brace."""

    def __init__(self, kind, text, start, end):
        self.kind, self.text, self.start, self.end = kind, text, start, end
        self.spaced = False  # between white space: a binary operator
        self.scope = None
        self.parens = 0
        self.partner = None  # index of the other bracket


class Scope:
    """A pair of braces: `kind` is file, namespace, class, enum, function, block or list (of values)."""

    def __init__(self, kind, parent, is_constexpr, head):
        self.kind, self.parent, self.is_constexpr = kind, parent, is_constexpr
        self.head = head  # the text before the brace

    def inFunction(self):
        return self.kind in ("function", "block") or (self.kind == "list" and self.parent.inFunction())


def tokens(text):
    """The tokens of a source, comments and directives left out, with their brackets and scopes."""
    found = []
    for match in TOKEN.finditer(text):
        kind = match.lastgroup if match.lastgroup != "raw" else "string"
        if kind in ("comment", "directive"):
            continue
        start, end = match.span()
        if match.group() == ">>" and not _spaced(text, start, end):
            found += [Token("op", ">", start, start + 1), Token("op", ">", start + 1, end)]
            continue
        token = Token(kind, match.group(), start, end)
        token.spaced = _spaced(text, start, end)
        found.append(token)
    _nest(found)
    return found


def _spaced(text, start, end):
    return text[start - 1:start].isspace() and text[end:end + 1].isspace()


def isAngle(tokens_, index):
    """Whether this < or > is the bracket of a template."""
    token = tokens_[index]
    if token.text not in ("<", ">"):
        return False
    return not token.spaced or (index > 0 and tokens_[index - 1].text == "template")


def _nest(found):
    scope = Scope("file", None, False, [])
    scopes, brackets, angles, parens = [scope], [], [], [0]
    for i, token in enumerate(found):
        if token.text in (")", "]") and parens[-1]:
            parens[-1] -= 1
        if token.text == "}" and len(scopes) > 1:
            scopes.pop()
            parens.pop()
        token.scope, token.parens = scopes[-1], parens[-1]
        if token.text in OPEN:
            brackets.append(i)
            angles.append([])
            if token.text == "{":
                scopes.append(_scopeFrom(found, i, scopes[-1], parens[-1]))
                parens.append(0)
            else:
                parens[-1] += 1
        elif token.text in (")", "]", "}") and brackets:
            token.partner = brackets.pop()
            found[token.partner].partner = i
            angles.pop()
        elif isAngle(found, i):
            own = angles[-1] if angles else []
            if token.text == "<":
                own.append(i)
            elif own:
                token.partner = own.pop()
                found[token.partner].partner = i


def _scopeFrom(found, at, around, parens):
    """What the brace at index `at` opens."""
    head = []
    i = at - 1
    while i >= 0 and len(head) < 200:
        token = found[i]
        if token.text in (")", "]") and token.partner is not None:
            head.append(token.text)
            i = token.partner
            head.append(found[i].text)
            i -= 1
            continue
        if token.text == "}" and token.partner is not None and _opened(found, token.partner) == "list":
            head += ["}", "{"]
            i = token.partner - 1
            continue
        if token.text in (";", "{", "}", "(", "["):
            break
        head.append(token.text)
        i -= 1
    head.reverse()
    found[at].opens = _kind(head, around, parens, found[at - 1].text if at else "")
    is_constexpr = around.is_constexpr or (found[at].opens == "function" and "constexpr" in head)
    return Scope(found[at].opens, around, is_constexpr, head)


def _opened(found, at):
    return getattr(found[at], "opens", "block")


def _kind(head, around, parens, before):
    inside = around.inFunction()
    if head[:2] == ["template", "<"] and ">" in head:  # a parameter may have a default
        head = head[head.index(">") + 1:]
    head = [word for i, word in enumerate(head) if word != "=" or i == 0 or head[i - 1] != "operator"]
    if "enum" in head:
        return "enum"
    if not inside and parens == 0:
        if "namespace" in head:
            return "namespace"
        if any(word in head for word in ("class", "struct", "union")) and ")" not in head:
            return "class"
        if ")" in head and "=" not in head and (before in (")", "}", "const", "noexcept", "override", "final", "try") or "->" in head):
            return "function"
        return "list"
    if before in (")", "else", "do", "try", "mutable", "noexcept", ";", "{", "}", ":"):
        return "block"
    if before == "]":  # a lambda without parameters
        return "block"
    return "block" if "->" in head[-4:] and before not in ("return", "=", ",", "(") and "]" in head else "list"


class Lines:
    """The line of an offset."""

    def __init__(self, text):
        self._starts = [0] + [m.end() for m in re.finditer("\n", text)]
        self._text = text

    def number(self, offset):
        return bisect.bisect_right(self._starts, offset)

    def line(self, offset):
        number = self.number(offset)
        end = self._starts[number] if number < len(self._starts) else len(self._text)
        return self._text[self._starts[number - 1]:end].strip()
