# SPDX-License-Identifier: Apache-2.0
"""How a peer is measured in turns with others: it says what it is, and measures once for every line that it gets."""
import json
import sys


def serve(introduction, measure, out=sys.stdout):
    """Writes `introduction`, then what `measure` returns for every line of the standard input; lines of JSON."""
    def write(document):
        print(json.dumps(document), file=out, flush=True)

    write(introduction)
    for _ in sys.stdin:
        write(measure())
