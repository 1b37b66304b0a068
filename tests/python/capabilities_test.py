"""The installed package: every capability, its errors, pictures and types.

Run by the environment's python, with TURNWRIGHT_PROGRAM, the command line to compare with.
"""
import json
import os
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import xml.etree.ElementTree
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import turnwright

try:
    import numpy
except ImportError:
    numpy = None

SWEEP = turnwright.example("stability") | {
    "speeds_rpm": {"from": 5000, "to": 19000, "count": 4000}}


def cantilever(load_N=1000):
    return {"shaft": {"E_MPa": 210000, "nu": 0.3, "segments": [
                {"length_mm": 100, "outer_left_mm": 40, "outer_right_mm": 40}]},
            "clamping": {"method": "chuck"}, "positions_mm": [50, 100],
            "load": {"Fr_N": load_N, "Ft_N": 0, "Fa_N": 0}}


class Capabilities(unittest.TestCase):
    def test_every_example_is_answered(self):
        for row in turnwright.capabilities():
            with self.subTest(row["name"]):
                function = getattr(turnwright, turnwright._naming.identifier(row["name"]))
                result = function(row["example"])
                self.assertEqual(result["turnwright_version"], turnwright.__version__)
                self.assertIn(row["summary"].split(" -> ")[0], function.__doc__)

    def test_the_answer_is_the_command_lines(self):
        for name in ("deflection", "plan"):
            request = turnwright.example(name)
            said = subprocess.run([os.environ["TURNWRIGHT_PROGRAM"], name, "--json", "-"],
                                  input=json.dumps(request), text=True, capture_output=True,
                                  check=True).stdout
            self.assertEqual(getattr(turnwright, name)(request), json.loads(said))

    def test_infeasible_is_a_result(self):
        part = turnwright.document("parts", "pump-shaft")
        part["outer"][0]["Ra_um"] = 0.02
        self.assertEqual(turnwright.plan(part)["status"], "infeasible")

    def test_data_are_the_packages(self):
        self.assertTrue(turnwright.Catalogue().folder.is_relative_to(
            Path(turnwright.__file__).parent))
        self.assertIn("C45", turnwright.ids("materials"))
        with self.assertRaisesRegex(KeyError, "pump-shaft"):
            turnwright.document("parts", "pump-shafd")

    def test_names_that_are_none(self):
        with self.assertRaisesRegex(KeyError, "plan"):
            turnwright.example("plane")
        for kind in ("../..", "nuts"):
            with self.assertRaisesRegex(KeyError, "materials"):
                turnwright.ids(kind)
            with self.assertRaisesRegex(KeyError, "materials"):
                turnwright.document(kind, "C45")

    def test_own_catalogue(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(["cp", "-r", *turnwright.Catalogue().folder.iterdir(), folder],
                           check=True)
            (Path(folder) / "materials" / "C45.json").unlink()
            own = turnwright.Catalogue(folder)
            with self.assertRaisesRegex(turnwright.InputError, "/material: got \"C45\""):
                turnwright.plan(turnwright.example("plan"), catalogue=own)
        with self.assertRaisesRegex(turnwright.InputError, "nowhere"):
            turnwright.Catalogue("/nowhere")


class Errors(unittest.TestCase):
    def test_every_problem_has_its_place(self):
        request = cantilever() | {"clampin": {}}
        request["shaft"]["nu"] = "a third"
        with self.assertRaises(turnwright.InputError) as raised:
            turnwright.deflection(request)
        self.assertEqual({problem.pointer for problem in raised.exception.problems},
                         {"/shaft/nu", "/clampin"})
        again = pickle.loads(pickle.dumps(raised.exception))
        self.assertEqual(again.problems, raised.exception.problems)

    def test_what_json_does_not_have_is_refused_with_its_place(self):
        request = cantilever(float("nan"))
        request["positions_mm"] = [1, {2}, float("inf")]
        with self.assertRaises(turnwright.InputError) as raised:
            turnwright.deflection(request)
        self.assertEqual([problem.pointer for problem in raised.exception.problems],
                         ["/positions_mm/1", "/positions_mm/2", "/load/Fr_N"])

    def test_a_request_that_holds_itself(self):
        request = cantilever()
        request["load"] = request
        with self.assertRaises(turnwright.InputError):
            turnwright.deflection(request)

    def test_outside_a_models_range(self):
        request = turnwright.example("stability") | {
            "speeds_rpm": {"from": 1, "to": 2, "count": 2}}
        del request["points"]
        with self.assertRaises(turnwright.ModelRangeError):
            turnwright.stability(request)


class Ends(unittest.TestCase):
    def test_progress_rises_to_the_end(self):
        told = []
        turnwright.stability(turnwright.example("stability"),
                             progress=lambda done, all_: told.append((done, all_)))
        self.assertEqual(told[-1][0], told[-1][1])
        self.assertEqual(told, sorted(told))

    def test_stop_from_progress(self):
        stop, told = turnwright.Stop(), []

        def tell(done, all_):
            told.append(done)
            stop.request()
        with self.assertRaises(turnwright.Cancelled):
            turnwright.stability(SWEEP, progress=tell, stop=stop)
        self.assertEqual(len(told), 1)

    def test_what_progress_raises_comes_out(self):
        told = []

        def tell(done, all_):
            told.append(done)
            raise ZeroDivisionError
        with self.assertRaises(ZeroDivisionError):
            turnwright.stability(SWEEP, progress=tell)
        self.assertEqual(len(told), 1)  # and the sweep went no further

    def test_control_c(self):
        begun, told = threading.Event(), []

        def tell(done, all_):
            begun.set()
            told.append((done, all_))

        def interrupt():
            begun.wait()
            os.kill(os.getpid(), signal.SIGINT)
        threading.Thread(target=interrupt).start()
        with self.assertRaises(KeyboardInterrupt):
            turnwright.stability(SWEEP, progress=tell)
        so_far = told[-1]
        self.assertLess(*so_far)  # the sweep did not run to its end,
        time.sleep(0.05)
        self.assertEqual(told[-1], so_far)  # and does not go on

    def test_other_threads_run_meanwhile(self):
        calls, over = [], threading.Event()

        def sweep():
            turnwright.stability(SWEEP)
            over.set()
        threading.Thread(target=sweep).start()
        while not over.is_set():
            calls.append(time.monotonic())
            time.sleep(1e-3)
        pauses = [b - a for a, b in zip(calls, calls[1:])]
        self.assertGreater(len(pauses), 5)
        self.assertLess(max(pauses), 0.8 * (calls[-1] - calls[0]))

    def test_threads_get_the_same(self):
        with ThreadPoolExecutor(4) as pool:
            results = list(pool.map(turnwright.deflection, [cantilever()] * 100))
        self.assertTrue(all(result == results[0] for result in results))


class Shown(unittest.TestCase):
    def test_pictures_are_svg_and_the_result_is_the_same(self):
        for name in ("stability", "geometry", "plan"):
            later = getattr(turnwright, name)(turnwright.example(name))
            at_once = getattr(turnwright, name)(turnwright.example(name), drawings=True)
            self.assertEqual(later.drawings, at_once.drawings)
            self.assertTrue(later.drawings)
            self.assertIn("_drawn", vars(at_once))  # not drawn once more
            for svg in later.drawings.values():
                self.assertTrue(xml.etree.ElementTree.fromstring(svg).tag.endswith("svg"))
            self.assertEqual(later._repr_svg_(), next(iter(later.drawings.values())))
            self.assertEqual(later.report is None, name == "geometry")
        self.assertIsNone(turnwright.deflection(cantilever())._repr_svg_())

    def test_results_travel_between_processes(self):
        result = turnwright.geometry(turnwright.example("geometry"))
        again = pickle.loads(pickle.dumps(result))
        self.assertEqual(again, result)
        self.assertEqual(again.drawings, result.drawings)

    @unittest.skipUnless(numpy, "needs NumPy")
    def test_numpy_in_and_out(self):
        listed = cantilever()
        arrays = cantilever(numpy.int64(1000)) | {"positions_mm": numpy.array([50, 100])}
        result = turnwright.deflection(arrays)
        self.assertEqual(result, turnwright.deflection(listed))
        columns = turnwright.columns(result["positions"])
        numpy.testing.assert_array_equal(columns["a_mm"], [50, 100])
        self.assertEqual(columns["delta_r_mm"][1], result["positions"][1]["delta_r_mm"])
        gaps = turnwright.columns([{"x": 1, "name": "a", "on": True}, {"x": None}])
        self.assertEqual(list(gaps), ["x"])
        numpy.testing.assert_array_equal(gaps["x"], [1, numpy.nan])


class Types(unittest.TestCase):
    def test_documents_have_types(self):
        from turnwright import documents
        self.assertEqual(documents.DeflectionRequest.__required_keys__, {"shaft", "clamping"})
        stub = Path(turnwright.__file__).with_suffix(".pyi").read_text()
        for name in turnwright.__all__:
            self.assertRegex(stub, rf"\b{name}\b")

    def test_a_checker_finds_slips(self):
        if subprocess.run([sys.executable, "-m", "mypy", "--version"],
                          capture_output=True).returncode:
            self.skipTest("needs mypy")
        with tempfile.NamedTemporaryFile("w", suffix=".py") as file:
            file.write("import turnwright\n"
                       "r = turnwright.chuck({'test': []})\n"
                       "x: str = turnwright.multipass({'dt_mm': 8}).document['UC']\n")
            file.flush()
            said = subprocess.run([sys.executable, "-m", "mypy", "--python-executable",
                                   sys.executable, file.name], capture_output=True, text=True)
        self.assertIn('Extra key "test" for TypedDict "ChuckRequest"', said.stdout)
        self.assertIn('expression has type "Optional[float]"', said.stdout)


if __name__ == "__main__":
    unittest.main()
