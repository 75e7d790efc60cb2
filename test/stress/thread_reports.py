#!/usr/bin/python3
"""Prints the reports of ThreadSanitizer that are not about roscpp and log4cxx themselves, and how many there are.

Usage: thread_reports.py FILE... These libraries are not built with ThreadSanitizer: it does not see that they count references
and take locks in an order of their own. A report is theirs where both accesses, or all locks, are made by their functions, at
the most through the standard library and Boost. Exit status 0 only if no report is left.
"""
import re
import sys

FRAME = re.compile(r'^ +#\d+ (.*)')
# Also what roscpp reads messages with.
THROUGH = re.compile(r'.*contact_path::(BoundedIStream|ReadBounded)|operator (delete|new)|pthread_|mem(cpy|move|set)\b|(void |bool )?(boost|std)::|__|(free|malloc|close|poll|send|recv|read|write)\b')
THEIRS = re.compile(r'(\w+ )?(ros|log4cxx)::|.*\((libroscpp|librosconsole|liblog4cxx|libxmlrpcpp)\.')


def first_frames(report):
    """Of each stack the first frame that is not of the standard library; if all are, one of roscpp, if there is one."""
    stacks, in_stack = [], False
    for line in report.splitlines():
        frame = FRAME.match(line)
        if frame:
            if not in_stack:
                stacks.append([])
            stacks[-1].append(frame.group(1))
        in_stack = bool(frame)
    firsts = []
    for stack in stacks:
        candidates = [frame for frame in stack if not THROUGH.match(frame)]
        candidates += [frame for frame in stack if THEIRS.match(frame)] + stack
        firsts.append(candidates[0])
    return firsts


def is_theirs(report):
    # The stacks after these tell where threads, locks and memory come from.
    accesses = re.split(r'\n +(?:Mutex M\d+ \(.*created|Thread T\d+|Location is|As if)', report)[0]
    frames = first_frames(accesses)
    return bool(frames) and all(THEIRS.match(frame) for frame in frames)


def main():
    ours = total = 0
    for file in sys.argv[1:]:
        with open(file, encoding='utf-8', errors='replace') as text:
            for report in text.read().split('==================\n'):
                if 'WARNING: ThreadSanitizer' not in report:
                    continue
                total += 1
                if not is_theirs(report):
                    ours += 1
                    print(report)
    print('%d reports, %d not about roscpp and log4cxx themselves' % (total, ours))
    return 1 if ours else 0


if __name__ == '__main__':
    sys.exit(main())
