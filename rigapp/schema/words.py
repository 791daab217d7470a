"""The terms of the alarm list and their meanings.

The window shows them as tool tips; the table of the operator's guide says the same.
"""

from __future__ import annotations

from collections.abc import Mapping

from rigapp.texts import say

WORDS: Mapping[str, str] = {
    "unacknowledged": say("the condition is present and not acknowledged"),
    "acknowledged": say("the condition is present and acknowledged"),
    "returned": say(
        "the condition of this warning ended before it was acknowledged; acknowledging"
        " removes it from the list"
    ),
    "latched": say(
        "a critical alarm whose condition is over; it forbids a start until it is"
        " acknowledged and reset"
    ),
    "shelved": say("hidden for a limited time, with a reason; limits act all the same"),
    "first": say("the first critical alarm since the last reset: check its cause first"),
    "Drive warning": say(
        "the drive reports a warning itself, usually about supply, temperature or load;"
        " errors on its line are counted beside the device and are no warning"
    ),
}
"""Term as shown in the window -> meaning."""
