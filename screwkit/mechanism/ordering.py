"""Names in an order in which each comes after those it is made of.

Kahn's algorithm: count what each still waits for, and take whoever waits for nothing.
What is never taken depends on itself.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping, Set


def in_order_of_need(needs: Mapping[str, Set[str]]) -> tuple[str, ...]:
    """The names, each after what it needs of the others.

    What depends on itself, or on such a name, is left out.

    >>> in_order_of_need({"a": {"c"}, "b": {"b"}, "c": set(), "d": {"b", "c"}})
    ('c', 'a')
    """
    waiting = {name: len(needed & needs.keys()) for name, needed in needs.items()}
    users: dict[str, list[str]] = {name: [] for name in needs}
    for name, needed in needs.items():
        for other in needed & needs.keys():
            users[other].append(name)
    ready = deque(name for name, count in waiting.items() if not count)
    found = []
    while ready:
        name = ready.popleft()
        found.append(name)
        for user in users[name]:
            waiting[user] -= 1
            if not waiting[user]:
                ready.append(user)
    return tuple(found)
