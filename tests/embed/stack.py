"""stack.py CALLGRAPH.ci LIMIT: the deepest path of the call graph that gcc -fcallgraph-info=su wrote.

Fails where it needs more than LIMIT bytes of stack, where a frame has no fixed size, and where
functions call themselves in a circle: recursion could grow with the input.
"""

import re
import sys


def read_graph(path):
    frames, calls = {}, {}
    text = open(path, encoding="utf-8").read()
    for title, label in re.findall(r'node: \{ title: "([^"]*)" label: "([^"]*)"', text):
        size = re.search(r"(\d+) bytes \((\w+(?:,\w+)?)\)", label)
        frames[title] = (int(size[1]), size[2]) if size else (0, "static")
    for source, target in re.findall(r'sourcename: "([^"]*)" targetname: "([^"]*)"', text):
        calls.setdefault(source, set()).add(target)
    return frames, calls


def deepest(frames, calls):
    """The bytes below each function, callees first; None and a circle where there is one."""
    depth, state = {}, {}
    for root in sorted(frames):
        stack = [(root, iter(sorted(calls.get(root, ()))))]
        if state.get(root) == "done":
            continue
        state[root] = "open"
        while stack:
            node, rest = stack[-1]
            for callee in rest:
                if state.get(callee) == "open":
                    return None, [name for name, _ in stack] + [callee]
                if callee in frames and callee not in state:
                    state[callee] = "open"
                    stack.append((callee, iter(sorted(calls.get(callee, ())))))
                    break
            else:
                below = max((depth.get(c, (0, ""))[0] for c in calls.get(node, ())), default=0)
                via = max(calls.get(node, ()), key=lambda c: depth.get(c, (0, ""))[0], default="")
                depth[node] = (frames[node][0] + below, via)
                state[node] = "done"
                stack.pop()
    return depth, None


def main():
    frames, calls = read_graph(sys.argv[1])
    limit = int(sys.argv[2])
    if len(frames) < 100:
        sys.exit(f"only {len(frames)} functions: this reads nothing")
    wild = [name for name, (_, kind) in frames.items() if kind.startswith("dynamic") and "bounded" not in kind]
    if wild:
        sys.exit(f"frames without a fixed size: {wild}")
    depth, circle = deepest(frames, calls)
    if circle:
        sys.exit("functions that call themselves: " + " -> ".join(circle))
    name, (bytes_needed, _) = max(depth.items(), key=lambda item: item[1][0])
    print(f"deepest path: {bytes_needed} bytes, {len(frames)} functions")
    while name:
        print(f"  {frames[name][0]:6d}  {name}")
        name = depth.get(name, (0, ""))[1]
    sys.exit(bytes_needed > limit)


main()
