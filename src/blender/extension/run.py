"""The simplifier in a thread of its own, so that Blender's window stays alive."""

import pathlib
import tempfile
import threading


class Cancelled(Exception):
    """The user has pressed Esc."""


class Run(threading.Thread):
    """Simplifies a file into one or more.

    targets  levels of detail, or one dict with the keyword of a target
    options  other keywords of faqem.simplify()
    """

    def __init__(self, targets, options):
        super().__init__(daemon=True)
        self._folder = tempfile.TemporaryDirectory(prefix="faqem-")
        self.source = pathlib.Path(self._folder.name, "source.glb")
        self._targets, self._options = targets, options
        self.is_cancelled = False
        self.progress = ""  # for the status bar
        self.paths, self.reports, self.warnings, self.error = [], [], [], None

    def remove_files(self):
        """Removes the source and the results."""
        self._folder.cleanup()

    def _report_progress(self, phase, fraction):
        if self.is_cancelled:
            raise Cancelled
        self.progress = f"{phase} {fraction:.0%}"

    def run(self):
        """Called by start(). Sets `paths`, or else `error`."""
        try:
            import faqem  # late: it takes its time, and its errors are those of a run

            options = {**self._options, "progress": self._report_progress}
            model = faqem.load(self.source)
            results = ([faqem.simplify(model, **self._targets, **options)] if isinstance(self._targets, dict)
                       else faqem.simplify_levels(model, self._targets, **options))
            for number, result in enumerate(results):
                self._report_progress("save", number / len(results))
                path = self.source.with_name(f"result-{number}.glb")
                faqem.save(result, path)
                self.paths.append(path)
                self.reports.append(result.report)
            self.warnings = list(dict.fromkeys(text for result in [model, *results] for text in result.warnings))
        except Exception as error:
            self.error = error
