"""What a joint relaxation needs not say, so that the solver has less to look at."""

ABSENT, ALWAYS = -1, -2


def batch_executions(batch, number):
    """Executions to which the item with this number (from 0) can belong."""
    first = number // batch["most"]
    last = first if batch["full"] else number
    return range(first, min(last + 1, len(batch["begins"])))


def useful_nodes(data):
    """Nodes without which some needed node could not be: all others can be left out of a solution.

    Backwards from the needed nodes through everything that makes a node wait for others.
    """
    before = [[] for _ in data["nodes"]]
    for earlier, node, _ in data["precedences"]:
        if earlier >= 0:
            before[node].append(earlier)
    for either in data["eithers"]:
        for option in either["options"]:
            before[either["node"]].extend(option)
    for batch in data["batches"]:
        for number, item in enumerate(batch["items"]):
            if number > 0:
                before[item].append(batch["items"][number - 1])
            for execution in batch_executions(batch, number):
                for nodes in (batch["before_decision"], batch["before_next_decision"]):
                    if nodes and nodes[number] >= 0:
                        before[item].append(nodes[number])
                for nodes in (batch["begins"], batch["decided"], batch["ends"]):
                    if execution < len(nodes):
                        before[item].append(nodes[execution])
    for resource in data["resources"]:
        for take, begin, anchor, free, _, _, _ in resource["jobs"]:
            if take >= 0:
                before[take].extend(node for node in (begin, anchor, free) if node >= 0)
    useful = [needed for _, needed, _ in data["nodes"]]
    todo = [node for node, needed in enumerate(useful) if needed]
    while todo:
        for node in before[todo.pop()]:
            if not useful[node]:
                useful[node] = True
                todo.append(node)
    return useful


def _bound_otherwise(data):
    """Nodes that more than precedences binds to an earliest time."""
    bound = {either["node"] for either in data["eithers"]}
    for batch in data["batches"]:
        bound.update(batch["items"])
        bound.update(batch["ends"])
        if batch["before_decision"] or batch["before_next_decision"]:
            bound.update(batch["decided"])
    for resource in data["resources"]:
        bound.update(node for node, _ in resource["instants"])
        for take, _, anchor, _, _, _, _ in resource["jobs"]:
            bound.update(node for node in (take, anchor) if node >= 0)
    return bound


def copies(data):
    """{node: (other, lag)}: needed nodes that may as well happen right when the only needed node
    that they wait for allows it: earlier is never worse for what comes after."""
    bound = _bound_otherwise(data)
    waits = [{} for _ in data["nodes"]]
    for earlier, node, lag in data["precedences"]:
        if earlier >= 0:
            waits[node][earlier] = max(lag, waits[node].get(earlier, lag))
    found = {}
    for node, (least, needed, _) in enumerate(data["nodes"]):
        if not needed or node in bound:
            continue
        rest = dict(waits[node])
        previous = found.get(node - 1)
        # The n-th not before the (n - 1)-th: so they are already when both follow the same event.
        if previous and rest.get(node - 1) == 0 and rest.get(previous[0] + 1) == previous[1]:
            del rest[node - 1]
        if len(rest) != 1:
            continue
        other, lag = next(iter(rest.items()))
        if data["nodes"][other][1] and least <= data["nodes"][other][0] + lag:
            found[node] = (other, lag)
    return found
