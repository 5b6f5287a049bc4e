"""Measurements that can be interrupted and go on: a line of JSON per case that is measured."""
import concurrent.futures
import json
import threading


class Store:
    """Rows by case, in a file to which each new one is added at once. file: None keeps nothing."""

    def __init__(self, file):
        self.file = file
        self.rows = {}
        self.lock = threading.Lock()
        if file is not None and file.exists():
            for line in file.read_text().splitlines():
                try:
                    case, row = json.loads(line)
                except ValueError:
                    continue  # it was being written when the program was killed
                self.rows[json.dumps(case, sort_keys=True)] = row

    def get(self, case, measure):
        """The row of a case, a dictionary; measure() makes it if it is not there yet."""
        key = json.dumps(case, sort_keys=True)
        if key not in self.rows:
            row = measure()
            with self.lock:
                self.rows[key] = row
                self._keep(case, row)
        return {**case, **self.rows[key]}

    def get_all(self, cases, measure, parallel=1):
        """The rows of cases, of which so many are measured at a time by measure(case)."""
        with concurrent.futures.ThreadPoolExecutor(parallel) as pool:
            return list(pool.map(lambda case: self.get(case, lambda: measure(case)), cases))

    def _keep(self, case, row):
        if self.file is None:
            return
        self.file.parent.mkdir(parents=True, exist_ok=True)
        with self.file.open("a") as file:
            file.write(json.dumps([case, row]) + "\n")
