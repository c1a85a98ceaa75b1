"""The verbs, options and schemes that pages name in `inline code`."""
import re

# Options of other programs and scripts that pages name alone.
OF_OTHERS = {"--no-sandbox", "--fvc", "--ways", "--policy", "--sample", "--period"}


class Manual:
    """The manual page: a test of its own compares it with the help of every verb, so no verb is started here."""
    SHARED = ("OPTIONS OF SEVERAL VERBS", "MEMORY TRACES")

    def __init__(self, path):
        # The manual does not repeat what every verb has.
        self.text = path.read_text(encoding="utf-8").replace("\\-", "-") + "\n--help\n"
        sections, shared = {}, ""
        for kind, heading, text in re.findall(r"^\.(S[HS]) (.*)\n((?:(?!\.S[HS] ).*\n?)*)", self.text, re.M):
            if kind == "SS":
                for name in heading.split(", "):
                    sections[name] = text
            elif heading in self.SHARED:
                shared += text
        self.sections = {name: text + shared + "--help" for name, text in sections.items()}
        self.verbs = {name for name in sections if not name.startswith("-") and " " not in name}

    def of_verb(self, verb, rest):
        return self.sections.get(" ".join([verb, *rest[:1]]), self.sections[verb])


def has(text, option):
    return re.search(r"(?<![\w-])" + re.escape(option) + r"(?![\w-])", text) is not None


def commands_in(code, verbs):
    """Verb and further words of each command that the code names: after `tilepress`, or a verb followed by an option."""
    for part in re.split(r"\||&&| -- |(?<= )#", code):
        words = part.split()
        if "tilepress" in words[:-1]:
            at = words.index("tilepress")
            yield words[at + 1], words[at + 2:]
        elif len(words) > 1 and words[0] in verbs and words[1].startswith("--"):
            yield words[0], words[1:]


def options_in(words):
    for word in words:
        found = re.match(r"(--[a-z][a-z-]*|-[a-zA-Z])(?![a-z-])", word)
        if found:
            yield found.group(1)


def unknown_names(code, known):
    """What the code names and the command does not have."""
    for verb, rest in commands_in(code, known.verbs):
        if verb == "VERB":
            continue
        if verb not in known.verbs:
            yield f"`{code}`: there is no verb {verb}"
            continue
        for option in options_in(rest):
            if not has(known.of_verb(verb, rest), option):
                yield f"`{code}`: {verb} has no option {option}"
    if code.startswith("--"):
        for option in set(options_in(code.split())) - OF_OTHERS:
            if not has(known.text, option):
                yield f"`{code}`: no verb has an option {option}"


def specs_in(code, schemes):
    """Scheme specifications: after -s, or alone."""
    yield from re.findall(r"-s '?([a-z0-9]+(?::[^\s']+)?)'?(?= |$)", code)
    if re.fullmatch(r"[a-z0-9]+:[a-z]+=[^\s…]+", code) and code.split(":")[0] in schemes:
        yield code
