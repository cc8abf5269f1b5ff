# SPDX-License-Identifier: BSD-3-Clause
"""A page in headless Chromium, and what can be asked of it."""

import base64
import json
import time

from selenium import webdriver
from selenium.common.exceptions import ElementClickInterceptedException
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.actions.wheel_input import ScrollOrigin
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.wait import WebDriverWait

DESKTOP = 1300
PHONE = 390
HEIGHT = 900


class Browser:
    """Chromium without a window. Not for two threads."""

    def __init__(self):
        options = webdriver.ChromeOptions()
        # CI runs as root in a container: no sandbox, and little shared memory.
        for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars",
                         f"--window-size={DESKTOP},{HEIGHT}"):
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        service = webdriver.chrome.service.Service("/usr/bin/chromedriver")
        self.driver = webdriver.Chrome(service=service, options=options)

    def close(self):
        self.driver.quit()

    def open(self, page, width=DESKTOP, scheme="light"):
        """Loads the file anew and waits until its charts are drawn; what was logged before is forgotten."""
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": HEIGHT, "deviceScaleFactor": 1, "mobile": width == PHONE})
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {
            "features": [{"name": "prefers-color-scheme", "value": scheme}]})
        self.driver.get("about:blank")
        for log in ("browser", "performance"):
            self.driver.get_log(log)
        self.driver.get("file://" + page)
        self.wait_for("return [...document.querySelectorAll('.chart')].every(chart => chart.querySelector('canvas, .empty'))")

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def wait_for(self, script):
        WebDriverWait(self.driver, 60).until(lambda _: self.run(script))

    def errors(self):
        """What the page wrote onto the console since it was loaded."""
        return [entry["message"] for entry in self.driver.get_log("browser")]

    def requests(self):
        """Addresses that were asked for since the page was loaded, without the page and what it holds itself."""
        addresses = []
        for entry in self.driver.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                addresses.append(message["params"]["request"]["url"])
        return [address for address in addresses
                if not address.startswith("data:") and address.split("#")[0] != self.driver.current_url.split("#")[0]]

    def element(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def count(self, selector):
        return len(self.driver.find_elements(By.CSS_SELECTOR, selector))

    def text(self):
        return self.element("body").text

    def show(self, panel):
        """Scrolls to an element, and waits until what still moves the page has ended."""
        def stands_in_the_middle():
            self.run("arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})", panel)
            return self.driver.execute_async_script("""
                const [panel, done] = arguments;
                const top = () => panel.getBoundingClientRect().top;
                const before = top();
                setTimeout(() => done(top() === before), 100);""", panel)
        WebDriverWait(self.driver, 60).until(lambda _: stands_in_the_middle())

    def point_at(self, selector, x, y):
        """Moves the mouse to a pixel of an element, counted from its upper left corner."""
        panel = self.element(selector)
        self.show(panel)
        size = panel.size
        ActionChains(self.driver).move_to_element_with_offset(
            panel, round(x - size["width"] / 2), round(y - size["height"] / 2)).perform()

    def press(self, selector):
        """A button, wherever it is."""
        self.run("arguments[0].click()", self.element(selector))

    def click_on(self, button):
        """As the mouse does. What still moves the page between looking and clicking gets two more tries."""
        for tries_left in (2, 1, 0):
            self.show(button)
            try:
                return button.click()
            except ElementClickInterceptedException:
                if tries_left == 0:
                    raise  # it names what covers the button

    def click(self):
        ActionChains(self.driver).click().perform()

    def turn_wheel(self, selector, pixels, with_ctrl=False):
        """In the middle of an element; pixels > 0: towards the end of the page."""
        panel = self.element(selector)
        self.show(panel)
        actions = ActionChains(self.driver)
        if with_ctrl:
            actions.key_down(Keys.CONTROL)
        actions.scroll_from_origin(ScrollOrigin.from_element(panel), 0, pixels)
        if with_ctrl:
            actions.key_up(Keys.CONTROL)
        actions.perform()

    def type_key(self, key):
        ActionChains(self.driver).send_keys(key).perform()

    def swipe_up(self, selector, pixels=300):
        """One finger in the middle of an element; returns how far the page scrolled."""
        panel = self.element(selector)
        self.show(panel)
        x, y, before = self.run("const box = arguments[0].getBoundingClientRect();"
                                "return [box.x + box.width / 2, box.y + box.height / 2, window.scrollY]", panel)
        touch = lambda kind, points: self.driver.execute_cdp_cmd(
            "Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
        self.driver.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": True})
        touch("touchStart", [{"x": x, "y": y}])
        for step in range(1, 11):
            touch("touchMove", [{"x": x, "y": y - pixels * step / 10}])
        touch("touchEnd", [])
        time.sleep(1)  # the page follows in its own time, if it does
        self.driver.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": False})
        return self.run("return window.scrollY") - before

    def screenshot(self, path):
        """The page from top to bottom, with the pictures that would be loaded on the way down."""
        self.run("for (const image of document.images) image.loading = 'eager'")
        self.wait_for("return [...document.images].every(image => image.complete)")
        size = self.run("return [document.documentElement.clientWidth, document.documentElement.scrollHeight]")
        picture = self.driver.execute_cdp_cmd("Page.captureScreenshot", {
            "captureBeyondViewport": True, "clip": {"x": 0, "y": 0, "width": size[0], "height": size[1], "scale": 1}})
        with open(path, "wb") as file:
            file.write(base64.b64decode(picture["data"]))
