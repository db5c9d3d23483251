#!/usr/bin/env python3
"""Lower bound of a makespan by CP-SAT, for `linewright bound --solver cp-sat`.

Reads a JSON list of joint relaxations from standard input (one per way to share the tokens of the line's forks; the
meaning of every field is in include/linewright/bounds/joint_relaxation.hpp) and writes JSON lines:
{"bound": B, "closed": C, "cases": N, "seconds": S} as the proof goes on, the last one being the
result. B is proven: no run of any case ends before tick B.

usage: joint_bound.py --seconds S --threads N < RELAXATIONS
"""

import argparse
import json
import sys
import time

try:
    from ortools.sat.python import cp_model
except ImportError:
    sys.exit("ortools is not installed for this Python: pip install ortools")

from relaxation import ABSENT, ALWAYS, batch_executions, copies, useful_nodes


class Model:
    """One joint relaxation as a CP-SAT model."""

    def __init__(self, data):
        self.data = data
        self.limit = data["limit"]
        self.cp = cp_model.CpModel()
        self.make_nodes()
        self.add_end()
        self.add_precedences()
        self.add_eithers()
        self.add_batches()
        for resource in data["resources"]:
            self.add_resource(resource)

    def make_nodes(self):
        nodes = self.data["nodes"]
        self.needed = [needed for _, needed, _ in nodes]
        self.useful = useful_nodes(self.data)
        self.copies = copies(self.data)
        self.time = [None] * len(nodes)
        self.present = []
        for node, (least, needed, name) in enumerate(nodes):
            self.present.append(
                self.cp.new_bool_var("") if self.useful[node] and not needed else self.cp.new_constant(int(needed)))
            if node not in self.copies:
                self.time[node] = self.cp.new_int_var(least, self.limit - 1, name)
        for node in self.copies:
            other, lag = node, 0
            while other in self.copies:
                other, more = self.copies[other]
                lag += more
            self.time[node] = self.time[other] + lag
            self.cp.add(self.time[node] <= self.limit - 1)

    # -- rules --------------------------------------------------------------------------------

    def after(self, node, earlier, lag, *when):
        """Where all of `when` and the node hold: `earlier` is present, node >= earlier + lag."""
        if node == ABSENT or earlier == ALWAYS:
            return
        conditions = list(when)
        if not self.needed[node]:
            conditions.append(self.present[node])
        if earlier == ABSENT:
            if conditions:
                self.cp.add_bool_or([c.negated() for c in conditions])
            else:
                self.cp.add_bool_or([])
            return
        rule = self.cp.add(self.time[node] >= self.time[earlier] + lag)
        if conditions:
            rule.only_enforce_if(conditions)
        if not self.needed[earlier]:
            implied = self.cp.add_bool_or([self.present[earlier]])
            if conditions:
                implied.only_enforce_if(conditions)

    def add_precedences(self):
        for earlier, node, lag in self.data["precedences"]:
            if node not in self.copies:
                self.after(node, earlier, lag)

    def add_eithers(self):
        for either in self.data["eithers"]:
            node = either["node"]
            chosen = [self.cp.new_bool_var("") for _ in either["options"]]
            self.cp.add_bool_or(chosen + ([] if self.needed[node] else [self.present[node].negated()]))
            for literal, option in zip(chosen, either["options"]):
                for earlier in option:
                    self.after(node, earlier, 0, literal)

    # -- items that come in batches -----------------------------------------------------------

    def add_batches(self):
        self.batch_of = []
        for batch in self.data["batches"]:
            if batch["loaded_by"] >= 0:
                chosen = self.batch_of[batch["loaded_by"]]
            else:
                chosen = self.choose_batches(batch)
            self.batch_of.append(chosen)
            self.time_batches(batch, chosen)

    def choose_batches(self, batch):
        """[item][execution]: literals, exactly one per item that is present."""
        executions = len(batch["begins"])
        chosen = []
        for number, item in enumerate(batch["items"]):
            row = [self.cp.new_bool_var("") for _ in range(executions)]
            chosen.append(row)
            self.cp.add(sum(row) == self.present[item])
            for execution, literal in enumerate(row):
                if execution not in batch_executions(batch, number):
                    self.cp.add(literal == 0)
            if number > 0:  # not in an earlier execution than the item before
                for execution in range(executions - 1):
                    self.cp.add(sum(chosen[number - 1][execution + 1:]) + sum(row[:execution + 1]) <= 1)
        for execution in range(executions):
            self.cp.add(sum(row[execution] for row in chosen) <= batch["most"])
        return chosen

    def time_batches(self, batch, chosen):
        items, takes = batch["items"], batch["takes"]
        if batch["some"]:  # an execution that ends before the limit has moved its first item by then
            for execution, end in enumerate(batch["ends"]):
                self.cp.add(sum(row[execution] for row in chosen if execution < len(row)) >= self.present[end])
        # A transfer that takes over what was loaded may have fewer items before the limit.
        for number, item in enumerate(items):
            if number >= len(chosen):
                self.cp.add(self.present[item] == 0)
                continue
            for execution, literal in enumerate(chosen[number]):
                begin = batch["begins"][execution] if execution < len(batch["begins"]) else ABSENT
                end = batch["ends"][execution] if execution < len(batch["ends"]) else ABSENT
                self.after(item, begin, batch["before"] + takes, literal)
                self.after(end, item, batch["after"], literal)
                if number > 0:
                    self.after(item, items[number - 1], takes, literal, chosen[number - 1][execution])
                if batch["before_decision"]:
                    decided = batch["decided"][execution] if execution < len(batch["decided"]) else ABSENT
                    self.after(decided, batch["before_decision"][number], 1, literal)
                if batch["before_next_decision"]:
                    for later in batch["decided"][execution + 1:]:
                        self.after(later, batch["before_next_decision"][number], 1, literal)

    # -- resources ----------------------------------------------------------------------------

    def add_resource(self, resource):
        jobs = [job for job in resource["jobs"] if job[0] == ALWAYS or self.possible(job[0])]
        intervals = [self.stay(job, resource) for job in jobs]
        if resource["exclusive"] and resource["capacity"] == 1:
            self.cp.add_no_overlap(intervals)
        elif resource["exclusive"]:
            self.cp.add_cumulative(intervals, [1] * len(jobs), resource["capacity"])
        for node, before in resource["instants"]:
            if not self.possible(node):
                continue
            start = self.time[node] - before
            instant = self.cp.new_optional_interval_var(start, before, self.time[node], self.present[node], "")
            self.cp.add_no_overlap(intervals + [instant])
        if resource["lag"]:
            self.add_order(resource, jobs)

    def stay(self, job, resource):
        """From when the job takes the resource until another one can."""
        take, _, _, free, hold, kind, _ = job
        end = self.cp.new_int_var(0, 3 * self.limit, "")
        size = self.cp.new_int_var(hold, 3 * self.limit, "")
        present = self.cp.new_constant(1) if take == ALWAYS else self.present[take]
        if free >= 0:
            rule = self.cp.add(end >= self.time[free] + resource["recovery"][kind])
            if not self.needed[free]:
                rule.only_enforce_if(self.present[free])
                self.cp.add(end >= self.limit).only_enforce_if(self.present[free].negated(), present)
        elif free == ABSENT:
            self.cp.add(end >= self.limit)
        start = 0 if take == ALWAYS else self.time[take]
        return self.cp.new_optional_interval_var(start, size, end, present, "")

    def add_order(self, resource, jobs):
        """Which job follows which on the same resource, and the way between them."""
        arcs, spent = [], []
        first = self.add_first(resource, jobs, spent)
        for i, job in enumerate(jobs):
            take, _, _, free, _, kind, _ = job
            arcs.append((0, i + 1, first[i]))
            arcs.append((i + 1, 0, self.cp.new_bool_var("")))
            if not self.needed[take]:
                arcs.append((i + 1, i + 1, self.present[take].negated()))
            if free == ABSENT:
                continue
            for j, (next_take, begin, anchor, _, _, next_kind, _) in enumerate(jobs):
                if i == j:
                    continue
                literal = self.cp.new_bool_var("")
                arcs.append((i + 1, j + 1, literal))
                self.after(next_take, free, resource["recovery"][kind], literal)
                if anchor < 0:
                    continue
                lag = resource["lag"][kind][next_kind]
                self.after(anchor, free, lag, literal)
                if begin >= 0:
                    self.after(anchor, begin, resource["way"][kind][next_kind], literal)
                if self.is_needed(anchor):
                    spent.append(literal * lag)
        if resource["capacity"] == 1:
            arcs.append((0, 0, self.cp.new_bool_var("")))
            self.cp.add_circuit(arcs)
        else:
            self.cp.add_multiple_circuit(arcs)
            self.cp.add(sum(first) <= resource["capacity"])
        self.add_spent(resource, jobs, spent)

    def add_first(self, resource, jobs, spent):
        """By job: whether it is somebody's first one; and the way from where that one starts."""
        first = [self.cp.new_bool_var("") for _ in jobs]
        rows = []
        for ways in resource["first_way"]:
            rows.append([self.cp.new_bool_var("") for _ in jobs])
            self.cp.add_at_most_one(rows[-1])
            for literal, (_, begin, anchor, _, _, kind, _) in zip(rows[-1], jobs):
                if anchor >= 0 and begin >= 0:
                    self.after(anchor, begin, ways[kind], literal)
        for i, job in enumerate(jobs):
            if rows:
                self.cp.add(sum(row[i] for row in rows) == first[i])
            if self.is_needed(job[2]):
                spent.append(first[i] * self.data["nodes"][job[2]][0])
        return first

    def possible(self, node):
        return self.needed[node] or self.useful[node]

    def is_needed(self, node):
        return node >= 0 and self.needed[node]

    def add_spent(self, resource, jobs, spent):
        """Ways and work together fit before the end: what the solver's linear part does not see."""
        for job in jobs:
            base, each, batch = resource["work"][job[5]]
            if not self.is_needed(job[3]):
                continue
            spent.append(base)
            if batch >= 0:
                items = self.data["batches"][batch]["items"]
                for item, row in zip(items, self.batch_of[batch]):
                    if self.needed[item] and job[6] < len(row):
                        spent.append(each * row[job[6]])
        self.cp.add(sum(spent) <= resource["capacity"] * self.end)

    def add_end(self):
        self.end = self.cp.new_int_var(self.data["least_end"], self.limit - 1, "end")
        for node in self.data["ends"]:
            self.cp.add(self.end >= self.time[node])
            self.cp.add(self.present[node] == 1)
        self.cp.minimize(self.end)


class Proof:
    """Bounds of all cases; the least of them is what is proven of all runs."""

    def __init__(self, relaxations):
        self.relaxations = relaxations
        self.bounds = [one["least_end"] for one in relaxations]
        self.limit = relaxations[0]["limit"]
        self.closed = [False] * len(relaxations)
        self.started = time.monotonic()
        self.shown = None

    def raise_to(self, case, bound):
        self.bounds[case] = max(self.bounds[case], min(int(bound + 1 - 1e-6), self.limit))
        self.show()

    def show(self, force=False):
        line = {"bound": min(self.bounds), "closed": sum(self.closed), "cases": len(self.bounds)}
        if not force and line == self.shown:
            return
        self.shown = line
        print(json.dumps({**line, "seconds": round(time.monotonic() - self.started, 1)}), flush=True)

    def solve(self, case, seconds, threads):
        model = Model(self.relaxations[case])
        solver = cp_model.CpSolver()
        solver.parameters.max_time_in_seconds = seconds
        solver.parameters.num_workers = threads
        solver.parameters.random_seed = 1
        solver.best_bound_callback = lambda bound: self.raise_to(case, bound)
        status = solver.solve(model.cp)
        if status == cp_model.MODEL_INVALID:
            sys.exit("the solver refuses the model: " + model.cp.validate())
        self.closed[case] = status in (cp_model.OPTIMAL, cp_model.INFEASIBLE)
        if status == cp_model.INFEASIBLE:
            self.raise_to(case, self.limit)
        else:
            self.raise_to(case, solver.best_objective_bound)

    def run(self, seconds, threads):
        """The case with the lowest bound first; each gets its share of the time that is left."""
        until = self.started + seconds
        todo = sorted(range(len(self.relaxations)), key=lambda case: self.bounds[case])
        while todo:
            left = until - time.monotonic()
            if left <= 0.1:
                break
            case = todo.pop(0)
            self.solve(case, left / (len(todo) + 1), threads)
        self.show(force=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--seconds", type=float, required=True)
    parser.add_argument("--threads", type=int, required=True)
    arguments = parser.parse_args()
    Proof(json.load(sys.stdin)).run(arguments.seconds, arguments.threads)


if __name__ == "__main__":
    main()
