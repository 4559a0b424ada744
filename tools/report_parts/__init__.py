"""Parts of tools/report: the runs to make, keeping their results, and the sections of the page."""
