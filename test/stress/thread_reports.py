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
THROUGH = re.compile(r'.*contact_path::(BoundedIStream|ReadBounded)|operator (delete|new)|pthread_|mem(cpy|move|set)\b|(void |bool )?boost::|std::|__|(free|malloc|close|poll|send|recv|read|write)\b')
THEIRS = re.compile(r'(\w+ )?(ros|log4cxx)::|.*\((libroscpp|librosconsole|liblog4cxx|libxmlrpcpp)\.')


def first_frames(report):
    """Of each stack the first frame that is not of the standard library, or the last one if all are."""
    frames, in_stack = [], False
    for line in report.splitlines():
        frame = FRAME.match(line)
        if frame and not in_stack:
            frames.append(frame.group(1))
        elif frame and THROUGH.match(frames[-1]):
            frames[-1] = frame.group(1)
        in_stack = bool(frame)
    return frames


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
