# SPDX-License-Identifier: BSD-3-Clause
"""Opens the pages of loop-closure-report in a real browser, from disk, and uses them as a reader does.

Usage: report_browser_test.py LOOP_CLOSURE_REPORT SCREENSHOT_FOLDER [unittest arguments]
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

from selenium.webdriver.common.keys import Keys

from browser import DESKTOP, PHONE, Browser
from draw_run import Drive, write_run

APP = ""
SCREENSHOTS = ""


def make_report(folder, *arguments):
    subprocess.run([APP, "--run", folder, *arguments], check=True, capture_output=True)
    return os.path.join(folder, "report.html")


def setUpModule():
    PageTest.browser = Browser()
    unittest.addModuleCleanup(PageTest.browser.close)


class PageTest(unittest.TestCase):
    """One browser for all tests, one folder for those of a class."""

    browser = None

    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.scratch.cleanup)

    def path(self, name):
        return os.path.join(self.scratch.name, name)

    def expect_quiet(self):
        self.assertEqual(self.browser.errors(), [])
        self.assertEqual(self.browser.requests(), [])

    def expect_quiet_but_for_files(self):
        self.assertEqual(self.browser.errors(), [])
        self.assertEqual([address for address in self.browser.requests() if not address.startswith("file://")], [])

    def expect_fit(self):
        width, scrolled = self.browser.run("return [document.documentElement.clientWidth, document.documentElement.scrollWidth]")
        self.assertLessEqual(scrolled, width)
        beyond = self.browser.run("""
            const scrolls = one => one && (getComputedStyle(one).overflowX === 'auto' || scrolls(one.parentElement));
            return [...document.querySelectorAll('main *')]
              .filter(one => !scrolls(one) && one.getBoundingClientRect().right > document.documentElement.clientWidth + 1)
              .map(one => one.outerHTML.slice(0, 100))""")
        self.assertEqual(beyond, [])

    def expect_sense(self):
        for word in ("undefined", "NaN", "[object", "null"):
            self.assertNotIn(word, self.browser.text())

    def look_at(self, page, name):
        """In both widths, light and dark, and with FILD_FULL_TESTS in each of the four; keeps pictures.
        Leaves the page open as Browser.open() does."""
        looks = [(PHONE, "dark"), (DESKTOP, "light")]
        if "FILD_FULL_TESTS" in os.environ:
            looks = [(PHONE, "light"), (DESKTOP, "dark"), *looks]
        for width, scheme in looks:
            with self.subTest(name, width=width, scheme=scheme):
                self.browser.open(page, width, scheme)
                self.expect_quiet()
                self.expect_fit()
                self.expect_sense()
                kind = "phone" if width == PHONE else "desktop"
                self.browser.screenshot(os.path.join(SCREENSHOTS, f"{name}_{kind}_{scheme}.png"))


class Report(PageTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = os.path.join(cls.scratch.name, "run")
        write_run(Drive(200), folder)
        cls.page = make_report(folder, "--ground-truth", os.path.join(folder, "truth.tum"), "--protocol", "radius:5")

    def test_fits_every_screen(self):
        self.look_at(self.page, "report")
        self.assertEqual(self.browser.count(".chart .empty"), 0)

    def test_follows_the_light(self):
        shades = []
        for scheme in ("light", "dark"):
            self.browser.open(self.page, scheme=scheme)
            shades.append(self.browser.run("return getComputedStyle(document.body).backgroundColor"))
        self.assertNotEqual(*shades)

    def test_shows_the_numbers(self):
        self.browser.open(self.page)
        cards = self.browser.element("#headline").text
        for text in ("200\ncamera frames", "80\nloop closures", "1.000\nprecision (radius:5)", "trajectory error (ATE) after"):
            self.assertIn(text, cards)
        self.assertIn("--rawlog drive.rawlog", self.browser.element("#run-content").text)

    def point_at_a_loop(self):
        """Of those that have a picture; returns the frame."""
        frame, x, y = self.browser.run("""
            const chart = echarts.getInstanceByDom(byId('map-chart'));
            const query = run.loops.map(loop => loop.query).find(query => pictureOf(run, query));
            const at = frame => chart.convertToPixel('grid', bestTrajectory(run)[frame].slice(0, 2));
            return [query, ...at(query)]""")
        self.browser.point_at("#map-chart", x, y)
        return frame

    def test_an_edge_shows_its_picture_and_keeps_it(self):
        self.browser.open(self.page)
        frame = self.point_at_a_loop()
        self.browser.wait_for("const image = document.querySelector('.edge-tooltip img');"
                              "return image && image.complete && image.naturalWidth > 0 && image.offsetWidth > 0")
        self.assertIn(f"frame {frame} and frame", self.browser.element(".edge-tooltip").text)
        self.browser.click()
        self.browser.wait_for("return document.querySelector('#pinned figure img')?.naturalWidth > 0")
        self.browser.press("#pinned figcaption button")
        self.assertEqual(self.browser.count("#pinned figure"), 0)
        self.expect_quiet()

    def test_a_pair_can_be_seen_in_3d(self):
        self.browser.open(self.page)
        shown = "const image = document.querySelector('#gallery .views img'); return [image.src, image.alt]"
        flat = self.browser.run(shown)
        self.browser.press("#gallery .views .turn")
        standing = self.browser.run(shown)
        self.assertNotEqual(flat[0], standing[0])
        self.assertIn("in 3D", standing[1])
        self.browser.wait_for("const image = document.querySelector('#gallery .views img');"
                              "image.scrollIntoView(); return image.naturalWidth > 0")
        self.browser.press("#gallery .views .turn")
        self.assertEqual(self.browser.run(shown), flat)

    def test_full_size_is_pixel_by_pixel(self):
        for width in (DESKTOP, PHONE):
            with self.subTest(width=width):
                self.browser.open(self.page, width)
                self.browser.press("#gallery .picture")
                # draw_run.py draws them 1280 pixels wide, and the page holds them 700 pixels wide.
                self.browser.wait_for("return document.querySelector('dialog[open] img')?.naturalWidth === 1280")
                self.assertEqual(self.browser.run("return document.querySelector('dialog img').offsetWidth"), 1280)
                self.assertIn("loop closure", self.browser.element("dialog .caption").text)
                self.browser.press("dialog button[aria-label=close]")
                self.browser.wait_for("return !document.querySelector('dialog')")
                self.expect_quiet_but_for_files()

    def test_full_size_goes_on_to_the_next_picture(self):
        self.browser.open(self.page)
        self.browser.press("#gallery .picture")
        caption = "return document.querySelector('dialog .caption').textContent"
        first = self.browser.run(caption)
        self.browser.type_key(Keys.ARROW_RIGHT)
        self.browser.wait_for(f"{caption} !== {json.dumps(first)}")
        self.browser.press("dialog button[aria-label='previous picture']")
        self.browser.wait_for(f"{caption} === {json.dumps(first)}")
        self.browser.type_key(Keys.ESCAPE)
        self.browser.wait_for("return !document.querySelector('dialog')")

    def test_full_size_without_the_files_says_so(self):
        page = self.path("alone.html")
        shutil.copy(self.page, page)
        self.browser.open(page)
        self.browser.press("#gallery .picture")
        self.browser.wait_for("return document.querySelector('dialog .caption').textContent.includes('scaled down')")
        shown, natural = self.browser.run("const image = document.querySelector('dialog img');"
                                          "return [image.offsetWidth, image.naturalWidth]")
        self.assertEqual(shown, natural)
        self.assertLessEqual(natural, 700)

    def test_the_wheel_scrolls_the_page_over_every_chart(self):
        self.browser.open(self.page)
        charts = self.browser.run("return [...document.querySelectorAll('.chart')].map(chart => chart.id)")
        self.assertIn("map-chart", charts)
        for chart in charts:
            with self.subTest(chart):
                selector = "#" + chart
                self.browser.show(self.browser.element(selector))
                before = self.browser.run("return window.scrollY")
                self.browser.turn_wheel(selector, -200)
                self.browser.wait_for(f"return window.scrollY < {before} - 100")

    def test_a_finger_scrolls_the_page_over_the_map(self):
        self.browser.open(self.page, PHONE)
        self.assertGreater(self.browser.swipe_up("#map-chart"), 100)
        self.browser.press("#map .zoom button[title='zoom in']")
        self.assertEqual(self.browser.swipe_up("#map-chart"), 0, "a zoomed map moves instead")

    def map_extent(self):
        return self.browser.run("return echarts.getInstanceByDom(byId('map-chart')).convertFromPixel('grid', [100, 100])")

    def test_the_wheel_with_ctrl_zooms_the_map(self):
        self.browser.open(self.page)
        before = self.map_extent()
        self.browser.turn_wheel("#map-chart", -300, with_ctrl=True)
        self.browser.wait_for("return echarts.getInstanceByDom(byId('map-chart')).convertFromPixel('grid', [100, 100])[0]"
                              f" !== {before[0]}")

    def test_buttons_zoom_the_map_and_show_all_of_it(self):
        self.browser.open(self.page, PHONE)
        before = self.map_extent()
        self.browser.press("#map .zoom button[title='zoom in']")
        self.assertNotEqual(self.map_extent(), before)
        self.assertEqual(self.browser.run("return getComputedStyle(byId('map-chart')).touchAction"), "none")
        self.browser.press("#map .zoom button[title='show the whole map']")
        for now, then in zip(self.map_extent(), before):
            self.assertAlmostEqual(now, then, 6)
        self.assertEqual(self.browser.run("return getComputedStyle(byId('map-chart')).touchAction"), "pan-y")

    def test_paper_is_wide_enough_for_the_charts(self):
        self.browser.open(self.page)
        self.browser.run("window.dispatchEvent(new Event('beforeprint'))")
        widths = self.browser.run("return [...document.querySelectorAll('.chart canvas')].map(one => one.offsetWidth)")
        self.assertLessEqual(max(widths), 680)
        self.assertEqual(self.browser.count("main details:not([open])"), 0)
        self.browser.run("window.dispatchEvent(new Event('afterprint'))")
        self.assertGreater(self.browser.run("return document.querySelector('#inliers-chart canvas').offsetWidth"), 1000)
        self.assertGreater(self.browser.count("main details:not([open])"), 0)

    def test_the_table_filters(self):
        self.browser.open(self.page)
        rows = "return document.querySelectorAll('#frames tbody tr').length"
        self.assertEqual(self.browser.run(rows), 25)
        self.assertIn("101 of 200 frames", self.browser.element("#filter-count").text)  # without those too early
        self.browser.element("#filter-frame").send_keys("120-129")
        self.assertEqual(self.browser.run(rows), 10)
        self.browser.run("byId('filter-verdict').value = 'accepted'; byId('filter').dispatchEvent(new Event('input'))")
        self.assertEqual(self.browser.run(rows), 8)
        self.assertIn("8 of 200 frames", self.browser.element("#filter-count").text)
        self.browser.element("#filter-frame").clear()
        self.browser.element("#filter-frame").send_keys("no number")
        self.assertEqual(self.browser.run(rows), 0)
        self.assertIn("100-200", self.browser.element("#filter-count").text)
        for text, count in (("129-120", 8), ("121, 126-127", 3)):
            self.browser.element("#filter-frame").clear()
            self.browser.element("#filter-frame").send_keys(text)
            self.assertEqual(self.browser.run(rows), count, text)

    def test_the_table_sorts(self):
        self.browser.open(self.page)
        column = self.browser.run("return columns.findIndex(([name]) => name === 'inliers') + 1")
        values = f"return [...document.querySelectorAll('#frames tbody td:nth-child({column})')].map(cell => Number(cell.textContent))"
        for press, is_descending in enumerate((False, True)):
            self.browser.press(f"#frames th:nth-child({column}) .sort")
            shown = self.browser.run(values)
            self.assertEqual(shown, sorted(shown, reverse=is_descending), press)
            self.assertGreater(len(set(shown)), 1)

    def test_a_picture_in_a_row_leaves_the_columns_alone(self):
        widths = "return [...document.querySelectorAll('#frames thead th')].map(one => one.getBoundingClientRect().width)"
        for width in (DESKTOP, PHONE):
            with self.subTest(width=width):
                self.browser.open(self.page, width)
                self.browser.element("#filter-frame").send_keys("100-140")
                before = self.browser.run(widths)
                buttons = self.browser.driver.find_elements("css selector", "#frames tbody td button")
                for count, button in enumerate(buttons[:2], 1):
                    self.browser.click_on(button)
                    self.browser.wait_for("return [...document.querySelectorAll('#frames figure img')]"
                                          f".filter(image => image.naturalWidth > 0).length === {count}")
                self.assertEqual(self.browser.run(widths), before)
                seen = self.browser.run("return document.querySelector('#frames figure').getBoundingClientRect().width")
                self.assertLessEqual(seen, width)
                self.assertGreater(seen, 0.75 * min(width, 768))

    def test_a_row_shows_its_picture_without_a_mouse(self):
        self.browser.open(self.page)
        frame = self.browser.run("return run.loops.map(loop => loop.query).find(query => pictureOf(run, query))")
        self.browser.element("#filter-frame").send_keys(f"{frame}-{frame}")
        button = self.browser.element("#frames tbody button")
        button.send_keys("\n")
        self.assertEqual(button.get_attribute("aria-expanded"), "true")
        self.browser.wait_for("return document.querySelector('#frames figure img').naturalWidth > 0")
        button.send_keys("\n")
        self.assertEqual(self.browser.count("#frames figure"), 0)

    def test_a_point_of_a_chart_shows_its_frame(self):
        self.browser.open(self.page)
        frame, x, y = self.browser.run("""
            const frame = run.loops.map(loop => loop.query).find(query => pictureOf(run, query));
            const chart = echarts.getInstanceByDom(byId('inliers-chart'));
            return [frame, ...chart.convertToPixel('grid', [frame, run.frames.inliers[frame]])]""")
        self.browser.point_at("#inliers-chart", x, y)
        self.browser.click()
        self.browser.wait_for("return document.querySelector('#frames figure img')?.naturalWidth > 0")
        self.assertIn(f"frame {frame} and frame", self.browser.element("#frames figcaption").text)

    def test_a_tooltip_fits_a_phone(self):
        self.browser.open(self.page, PHONE)
        self.point_at_a_loop()
        self.browser.wait_for("return document.querySelector('.edge-tooltip img')?.offsetWidth > 0")
        left, right = self.browser.run("""
            const box = document.querySelector('.edge-tooltip').parentElement.getBoundingClientRect();
            return [box.left, box.right]""")
        self.assertGreaterEqual(left, 0)
        self.assertLessEqual(right, PHONE)

    def test_explains_its_words(self):
        self.browser.open(self.page)
        self.browser.run("document.querySelectorAll('details').forEach(one => one.open = true)")
        self.assertIn("root mean square distance", self.browser.element("#headline-words").text)
        self.assertIn("no earlier frame is old enough", self.browser.element("#verdict-words").text)
        self.assertNotIn("another version", self.browser.element("#verdict-words").text)

    def test_a_bar_filters_the_table(self):
        self.browser.open(self.page)
        x, y = self.browser.run("""
            const chart = echarts.getInstanceByDom(byId('reasons-chart'));
            const names = chart.getOption().yAxis[0].data;
            return chart.convertToPixel('grid', [50, names.indexOf('too early')])""")
        self.browser.point_at("#reasons-chart", x, y)
        self.browser.click()
        self.assertIn("100 of 200 frames", self.browser.element("#filter-count").text)
        self.browser.press("#pager button:last-child")
        self.assertIn("page 2 of 4", self.browser.element("#pager").text)

    def test_tells_how_alike_two_frames_are(self):
        self.browser.open(self.page)
        x, y = self.browser.run("return echarts.getInstanceByDom(byId('matrix-chart')).convertToPixel('grid', [20.5, 120.5])")
        self.browser.point_at("#matrix-chart", x, y)
        self.browser.wait_for("return byId('matrix-status').textContent.startsWith('frame 120 and frame 20: ')")

    def test_needs_no_truth(self):
        folder = self.path("untold")
        write_run(Drive(40), folder)
        self.browser.open(make_report(folder))
        self.expect_quiet()
        self.assertNotIn("precision", self.browser.element("#headline").text)


class JudgedReport(PageTest):
    """Of 80 loop closures 5 are wrong; of 101 frames that come back 26 have no right one."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = os.path.join(cls.scratch.name, "judged")
        write_run(Drive(200, wrong=5, probability=True), folder)
        cls.page = make_report(folder, "--ground-truth", os.path.join(folder, "truth.tum"), "--protocol", "radius:5")
        cls.browser.open(cls.page)  # once: the tests read, and set the filter that they need

    def series(self, chart):
        """Names of a chart's series and how many points each has."""
        return dict(self.browser.run(f"""
            return echarts.getInstanceByDom(byId('{chart}')).getOption().series.map(({{name, data}}) => [name, data.length])"""))

    def test_looks_right(self):
        self.look_at(self.page, "judged")

    def test_the_headline_counts_them(self):
        cards = self.browser.element("#headline").text
        for text in ("0.938\nprecision (radius:5)", "0.743\nrecall (radius:5)", "5\nwrong loop closures", "26\nmissed loops"):
            self.assertIn(text, cards)
        row = self.browser.element("#protocols tbody tr").text
        self.assertIn("radius:5 0.938 0.743 75 5 0 26 a loop closure is right when", row)

    def test_the_map_shows_each_kind(self):
        series = self.series("map-chart")
        self.assertEqual(series["right loop closures"], 75)
        self.assertEqual(series["wrong loop closures"], 5)
        self.assertEqual(series["missed loops"], 21)  # the other 5 are the wrong ones

    def test_charts_and_matrix_show_each_kind(self):
        for chart in ("support-chart", "inliers-chart", "similarity-chart"):
            with self.subTest(chart):
                series = self.series(chart)
                self.assertEqual((series["right"], series["wrong"], series["missed"]), (75, 5, 20))
        matrix = self.series("matrix-chart")
        self.assertEqual((matrix["right (mirrored)"], matrix["wrong (mirrored)"], matrix["missed (mirrored)"]), (75, 5, 21))

    def test_the_table_shows_and_filters_each_kind(self):
        for kind, count in (("right", 75), ("wrong", 5), ("missed", 21)):
            self.browser.run(f"byId('filter-truth').value = '{kind}'; byId('filter').dispatchEvent(new Event('input'))")
            self.assertIn(f"{count} of 200 frames", self.browser.element("#filter-count").text)
            self.assertIn(kind, self.browser.element("#frames tbody tr").text)
        self.assertIn("missed at ", self.browser.element("#frames tbody tr").text)

    def test_wrong_pairs_come_first_with_their_pictures(self):
        self.assertIn("Wrong loop closures (5)", self.browser.element("#wrong-title").text)
        self.assertEqual(self.browser.count("#wrong-gallery figure .kind.wrong"), 5)
        self.assertGreater(self.browser.count("#gallery figure .kind.right"), 0)

    def test_the_reason_is_the_one_that_decided(self):
        rejected = self.browser.element("#strongest-rejected figcaption").text
        self.assertIn("rejected: may be look alike", rejected)
        self.assertRegex(rejected, r"support 0\.9\d\d \(below 0\.95\)")
        line = self.browser.run("return echarts.getInstanceByDom(byId('inliers-chart')).getOption().series[0].markLine.label.formatter")
        self.assertIn("needed before support is measured", line)

    def test_all_numbers_are_there(self):
        self.browser.run("document.querySelectorAll('#truth details').forEach(one => one.open = true)")
        text = self.browser.element("#all-metrics").text
        for name in ("segment recall", "maximum F1", "average P", "RPE 10m"):
            self.assertIn(name, text)
        self.assertGreater(self.series("curve-chart")["by inliers"], 2)

    def test_edges_are_compared_with_what_they_claim(self):
        self.assertRegex(self.browser.element("#edge-verdict").text, r"off by [\d.]+ cm in the median")


class ReportOfAnUnusualRun(PageTest):
    def report_of(self, name, drive, **pictures):
        folder = self.path(name)
        write_run(drive, folder, **pictures)
        page = make_report(folder)
        self.look_at(page, name)
        return page

    def reason(self, panel):
        return self.browser.element(f"#{panel} .empty").text

    def test_without_metric_edges(self):
        self.report_of("no_edges", Drive(60, trajectory=False))
        self.assertIn("no odometry", self.reason("map-chart"))
        self.assertIn("no odometry", self.reason("graph-content"))
        self.assertGreater(self.browser.count("#gallery figure"), 0)

    def test_without_loops(self):
        self.report_of("no_loops", Drive(60, loops=False))
        self.assertIn("no loop closure", self.reason("gallery"))
        self.assertIn("Click a point", self.browser.element("#verdicts").text)
        self.assertIn("no loop closure", self.reason("edges-chart"))
        self.assertEqual(self.browser.count("#map-chart .empty"), 0)

    def test_of_a_single_frame(self):
        self.report_of("single_frame", Drive(1))
        self.assertIn("single position", self.reason("map-chart"))
        self.assertIn("no frame had a candidate", self.reason("inliers-chart"))
        self.assertNotIn("Click a point", self.browser.element("#verdicts").text)
        self.assertIn("single frame", self.reason("matrix-chart"))

    def test_of_five_thousand_frames(self):
        page = self.report_of("large", Drive(5000), accepted_pictures=100, rejected_pictures=20)
        self.assertLess(os.path.getsize(page), 25e6)


    def test_of_a_hundred_thousand_frames(self):
        folder = self.path("endless")
        write_run(Drive(100000), folder)
        page = make_report(folder)
        self.assertLess(os.path.getsize(page), 10e6)
        self.browser.open(page)
        self.expect_quiet()
        self.expect_fit()
        self.expect_sense()
        self.assertIn("100,000\ncamera frames\n40,000\nloop closures", self.browser.element("#headline").text)
        self.assertRegex(self.browser.element("#remarks").text, r"This page holds \d+ of 100000 frames: \d+ of 40000 loop closures")
        self.assertEqual(self.browser.element("#frames-title").text, "Frames in this page")
        self.assertRegex(self.browser.element("#filter-count").text, r"in this page; the recording has 100,000")
        last, x, y = self.browser.run("""
            const chart = echarts.getInstanceByDom(byId('inliers-chart'));
            const last = run.loops.at(-1).query;
            return [last, ...chart.convertToPixel('grid', [last, run.frames.inliers[last]])]""")
        self.assertGreater(last, 99900)
        self.browser.point_at("#inliers-chart", x, y)
        self.browser.click()  # of points that lie this close any may be the one
        self.browser.wait_for("return document.querySelectorAll('#frames tbody tr').length === 1")
        frame, inliers = self.browser.run("""
            const row = document.querySelector('#frames tbody tr');
            return [Number(row.dataset.frame), row.children[columns.findIndex(([name]) => name === 'inliers')].textContent]""")
        self.assertGreater(frame, 99000)
        self.assertEqual(inliers, str(self.browser.run(f"return run.frames.inliers[{frame}]")))


class Comparison(PageTest):
    def compare(self, first, second, *more):
        page = self.path("comparison.html")
        subprocess.run([APP, "--compare", first, second, "--output", page, *more], check=True, capture_output=True)
        return page

    def test_lays_two_runs_side_by_side(self):
        first, second = self.path("first"), self.path("second")
        write_run(Drive(200), first)
        write_run(Drive(200, loops=False, seed=2), second, {"index": {"backend": "exact"}})
        page = self.compare(first, second)
        self.look_at(page, "comparison")
        self.assertIn("80 0", self.browser.element("#metrics").text)
        self.assertIn("[index] backend hnsw exact", self.browser.element("#differing-options").text)
        self.assertIn("Only in first: 80", self.browser.element("#only-first-title").text)
        self.assertGreater(self.browser.count("#only-first .pair figure img"), 0)
        self.assertIn("none", self.browser.element("#only-second").text)

    def test_shows_the_loops_that_both_runs_miss(self):
        folders = [self.path(f"missing_{seed}") for seed in (1, 2)]
        for seed, folder in enumerate(folders, 1):
            write_run(Drive(200, loops=False, seed=seed), folder)
        truth = ["--ground-truth", os.path.join(folders[0], "truth.tum"), "--protocol", "radius:5"]
        self.browser.open(self.compare(*folders, *truth))
        self.expect_quiet()
        missed = self.browser.run("""
            const chart = echarts.getInstanceByDom(byId('loops-chart'));
            return chart.getOption().series.filter(one => one.name.startsWith('missed')).map(one => one.data.length)""")
        self.assertEqual(len(missed), 1)
        self.assertGreater(missed[0], 0)
        width = self.browser.run("return byId('loops-chart').offsetWidth / byId('loops-chart').parentElement.clientWidth")
        self.assertGreater(width, 0.9)

    def test_of_long_runs_counts_all_loops(self):
        folders = [self.path("long"), self.path("long_without_loops")]
        write_run(Drive(30000), folders[0])
        write_run(Drive(30000, loops=False), folders[1])
        self.browser.open(self.compare(*folders))
        self.expect_quiet()
        self.expect_sense()
        self.assertIn("loop closures 12,000 0", self.browser.element("#metrics").text)
        self.assertIn("Only in long: 12,000", self.browser.element("#only-first-title").text)
        self.assertIn("Only in long_without_loops: 0", self.browser.element("#only-second-title").text)

    def test_of_a_run_with_itself_finds_no_difference(self):
        folder = self.path("same")
        write_run(Drive(20), folder)
        self.browser.open(self.compare(folder, folder))
        self.expect_quiet()
        self.assertIn("same options", self.browser.element("#differing-options").text)


if __name__ == "__main__":
    APP, SCREENSHOTS = map(os.path.abspath, sys.argv[1:3])
    os.makedirs(SCREENSHOTS, exist_ok=True)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
