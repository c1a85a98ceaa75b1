"""Errors: the library's one line of text as an exception."""


class Error(ValueError):
    """A value, a file or bits that the library refuses. ``str(error)`` is one line.

    kind: "bad value", "file", "bad bits", "exists", "unsupported" or "system".
    """

    def __init__(self, text: str, kind: str = "bad value") -> None:
        super().__init__(text)
        self.kind = kind

    def __reduce__(self):
        return type(self), (str(self), self.kind)
