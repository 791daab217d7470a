"""The words of the alarm list, each with its one meaning.

The window shows them as tool tips; the table of the operator's guide says the same.
"""

from __future__ import annotations

from collections.abc import Mapping

from rigapp.texts import say

WORDS: Mapping[str, str] = {
    "unacknowledged": say("the condition holds, and nobody has acknowledged it"),
    "acknowledged": say("the condition holds, and somebody has acknowledged it"),
    "returned": say(
        "a warning whose condition is over before anybody has acknowledged it;"
        " acknowledging takes it off the list"
    ),
    "latched": say(
        "a critical alarm whose condition is over; it forbids a start until it is"
        " acknowledged and reset"
    ),
    "shelved": say("hidden for a limited time, with a reason; limits act all the same"),
    "first": say("the critical alarm that came first since the last reset: look there first"),
    "Drive warning": say(
        "the drive itself warns, as a rule of its supply, temperature or load; what is"
        " damaged on its line is counted beside the device and is no warning"
    ),
}
"""A word as the window shows it, and what it means."""
