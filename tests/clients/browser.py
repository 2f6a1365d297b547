# SPDX-License-Identifier: GPL-3.0-or-later
"""Debian's Chromium without a window, a graphics card or a network, for pages of `calotte view`."""

import json
import pathlib

from selenium import webdriver
from selenium.webdriver.chrome.service import Service

OPTIONS = [
    "--headless=new",
    "--no-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-dev-shm-usage",  # which containers keep small
    "--hide-scrollbars",
    "--host-resolver-rules=MAP * ~NOTFOUND",  # any name of a host is unknown
    "--disable-background-networking",
    "--disable-component-update",
    "--no-first-run",
]
SECONDS_FOR_A_SCRIPT = 120


class Browser:
    """A browser; in a `with` statement it ends at its end."""

    def __init__(self, width=1400, height=900):
        options = webdriver.ChromeOptions()
        options.binary_location = "/usr/bin/chromium"
        for option in OPTIONS + [f"--window-size={width},{height}"]:
            options.add_argument(option)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
        self.driver.set_script_timeout(SECONDS_FOR_A_SCRIPT)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.driver.quit()

    def open(self, path, fragment=""):
        """Opens a page from the disk, at a part of its address after it, and waits for its first picture."""
        self.driver.get(pathlib.Path(path).resolve().as_uri() + fragment)
        return self.asynchronous("calotte.ready")

    def save_to(self, folder):
        """Files that pages save go to a folder."""
        self.driver.execute_cdp_cmd("Browser.setDownloadBehavior",
                                    {"behavior": "allow", "downloadPath": str(pathlib.Path(folder).resolve())})

    def press(self, key):
        """Presses and releases a key where the focus is."""
        webdriver.ActionChains(self.driver).send_keys(key).perform()

    def run(self, script, *arguments):
        """The value of an expression that may use arguments[0] and so on."""
        return self.driver.execute_script(f"return {script}", *arguments)

    def asynchronous(self, promise, *arguments):
        """The value that a promise gives."""
        return self.driver.execute_async_script(
            f"const done = arguments[arguments.length - 1]; Promise.resolve({promise}).then(v => done(v ?? null))",
            *arguments)

    def console(self):
        """The messages in the console since the last call."""
        return [entry["message"] for entry in self.driver.get_log("browser")]

    def requests(self):
        """The addresses that the page asked for since the last call, but for itself and its own data."""
        found = []
        for entry in self.driver.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                url = message["params"]["request"]["url"]
                if not url.startswith(("file:", "data:", "blob:", "chrome")):
                    found.append(url)
        return found

    def screenshot(self, path):
        self.driver.save_screenshot(str(path))
