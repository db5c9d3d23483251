#!/usr/bin/env python3
"""Tests of what becomes of a joint relaxation on its way to the solver; those of the solver need ortools."""

import importlib.util
import unittest

import relaxation

HAS_ORTOOLS = importlib.util.find_spec("ortools") is not None
ABSENT = relaxation.ABSENT


def relaxation_of(nodes, ends, limit=100, **parts):
    """`nodes`: (least tick, needed)."""
    data = {"limit": limit, "least_end": 1, "ends": ends, "precedences": [], "eithers": [], "batches": [],
            "resources": [], "nodes": [[least, needed, f"n{i}"] for i, (least, needed) in enumerate(nodes)]}
    data.update(parts)
    return data


def machine(jobs, **more):
    resource = {"name": "machine", "capacity": 1, "jobs": jobs, "recovery": [0], "lag": [], "way": [],
                "first_way": [], "work": [], "instants": [], "exclusive": True}
    resource.update(more)
    return resource


def batch(items, executions, most, **more):
    made = {"items": items, "decided": executions, "begins": executions, "ends": executions, "most": most,
            "before": 0, "takes": 1, "after": 0, "loaded_by": -1, "full": False, "some": False,
            "before_decision": [], "before_next_decision": []}
    made.update(more)
    return made


class Relaxation(unittest.TestCase):
    def test_items_belong_to_the_only_execution_where_each_is_full(self):
        full = batch([0] * 6, [0] * 6, 4, full=True)
        self.assertEqual(list(relaxation.batch_executions(full, 3)), [0])
        self.assertEqual(list(relaxation.batch_executions(full, 4)), [1])

    def test_items_may_come_later_where_executions_need_not_be_full(self):
        some = batch([0] * 6, [0] * 3, 4)
        self.assertEqual(list(relaxation.batch_executions(some, 1)), [0, 1])
        self.assertEqual(list(relaxation.batch_executions(some, 5)), [1, 2])  # there are no more than three

    def test_what_no_needed_node_waits_for_is_useless(self):
        data = relaxation_of([(1, False), (1, False), (1, True)], [2], precedences=[[0, 2, 5]])
        self.assertEqual(relaxation.useful_nodes(data), [True, False, True])

    def test_whoever_takes_a_resource_needs_what_frees_it(self):
        data = relaxation_of([(1, True), (1, False)], [0],
                             resources=[machine([[0, ABSENT, ABSENT, 1, 0, 0, 0]])])
        self.assertEqual(relaxation.useful_nodes(data), [True, True])

    def test_what_waits_for_one_node_alone_happens_when_that_allows_it(self):
        data = relaxation_of([(1, True), (1, True), (1, True)], [2], precedences=[[0, 1, 5], [0, 2, 1], [1, 2, 1]])
        self.assertEqual(relaxation.copies(data), {1: (0, 5)})

    def test_what_a_resource_may_put_off_is_no_copy(self):
        data = relaxation_of([(1, True), (1, True)], [1], precedences=[[0, 1, 5]],
                             resources=[machine([[1, ABSENT, ABSENT, ABSENT, 0, 0, 0]])])
        self.assertEqual(relaxation.copies(data), {})


@unittest.skipUnless(HAS_ORTOOLS, "ortools is not installed")
class Proof(unittest.TestCase):
    def proven(self, *cases):
        import joint_bound

        proof = joint_bound.Proof(list(cases))
        proof.show = lambda force=False: None
        proof.run(10, 1)
        self.assertTrue(all(proof.closed))
        return min(proof.bounds)

    def two_jobs(self, **more):
        """Each takes the machine at an even node and lets it go ten ticks later at the odd one."""
        jobs = [[0, ABSENT, 0, 1, 0, 0, 0], [2, ABSENT, 2, 3, 0, 0, 1]]
        return relaxation_of([(1, True), (11, True), (1, True), (11, True)], [1, 3],
                             precedences=[[0, 1, 10], [2, 3, 10]], resources=[machine(jobs, **more)])

    def test_jobs_of_a_machine_come_one_after_the_other(self):
        self.assertEqual(self.proven(self.two_jobs(recovery=[2])), 23)

    def test_with_the_way_between_them(self):
        self.assertEqual(self.proven(self.two_jobs(lag=[[5]], way=[[0]], work=[[10, 0, -1]])), 26)

    def test_two_machines_do_two_jobs_at_once(self):
        self.assertEqual(self.proven(self.two_jobs(capacity=2)), 11)

    def test_the_least_of_the_cases_holds(self):
        self.assertEqual(self.proven(self.two_jobs(recovery=[2]), self.two_jobs(recovery=[7])), 23)

    def test_no_solution_below_the_limit_proves_the_limit(self):
        data = self.two_jobs(recovery=[2])
        data["limit"] = 20
        self.assertEqual(self.proven(data), 20)

    def test_full_batches_need_a_second_execution(self):
        # Five items, four at a time, one tick each; the second execution begins 30 ticks after the first.
        nodes = [(1, True), (31, True)] + [(2, True)] * 5
        items = batch([2, 3, 4, 5, 6], [0, 1], 4, full=True)
        data = relaxation_of(nodes, [6], precedences=[[0, 1, 30]], batches=[items])
        data["batches"][0]["ends"] = [ABSENT, ABSENT]
        self.assertEqual(self.proven(data), 32)


if __name__ == "__main__":
    unittest.main()
