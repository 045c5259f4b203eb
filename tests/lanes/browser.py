# SPDX-License-Identifier: Apache-2.0
"""A headless Chromium for tests of pages. It is controlled by the DevTools protocol through a socket, and shows one page
after the other:

with Browser() as browser:
    page = browser.open("file:///tmp/page.html", width=400)
    assert not page.errors and page.evaluate("document.images.length") == 2
    page.save_picture("page.png")
"""
import base64
import json
import os
import signal
import socket
import subprocess
import tempfile

OPTIONS = ("--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--no-first-run", "--disable-extensions",
           "--disable-background-networking", "--disable-component-update", "--allow-file-access-from-files",
           "--remote-debugging-pipe", "about:blank")
TIMEOUT = 600  # seconds for an answer or for loading a page: minutes, for a busy machine
LARGEST_PICTURE = 16000  # pixels; Chromium draws higher pictures incompletely

# Ends when the images that scripts have added are loaded or have failed, and the page is laid out.
READY = """Promise.all(Array.from(document.images, image => image.decode().catch(() => {})))
  .then(() => new Promise(done => requestAnimationFrame(() => setTimeout(done))))"""

# Runs in each page before its scripts: pictures shall not show a transition that has just begun.
WITHOUT_TRANSITIONS = """{
  const sheet = new CSSStyleSheet();
  sheet.replaceSync('*, *::before, *::after { transition: none !important; }');
  document.adoptedStyleSheets = [sheet];
}"""


class Page:
    """The page that the browser shows. errors: errors of its scripts and requests, by text."""

    def __init__(self, browser):
        self.browser = browser
        self.width = 0
        self.errors = []

    def resize(self, width, height=800):
        """Changes the size of the window, in pixels."""
        self.width = width
        self.browser.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1,
                          mobile=False)
        self.evaluate(READY)

    def evaluate(self, expression):
        """Returns the value of an expression of JavaScript."""
        answer = self.browser.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if fault := answer.get("exceptionDetails"):
            raise RuntimeError(text_of(fault))
        return answer["result"].get("value")

    def save_picture(self, file):
        """Writes the whole page to a PNG file."""
        height = min(self.evaluate("document.scrollingElement.scrollHeight"), LARGEST_PICTURE)
        clip = {"x": 0, "y": 0, "width": self.width, "height": height, "scale": 1}
        answer = self.browser.call("Page.captureScreenshot", format="png", clip=clip, captureBeyondViewport=True,
                                   optimizeForSpeed=True)
        with open(file, "wb") as picture:
            picture.write(base64.b64decode(answer["data"]))


class Browser:
    def __init__(self):
        self.profile = tempfile.TemporaryDirectory()
        self.socket, theirs = socket.socketpair()
        self.socket.settimeout(TIMEOUT)
        # Chromium reads commands from file descriptor 3 and writes answers to 4.
        self.process = subprocess.Popen(
            ["chromium", f"--user-data-dir={self.profile.name}", *OPTIONS], stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True, pass_fds=(3, 4),
            preexec_fn=lambda: (os.dup2(theirs.fileno(), 3), os.dup2(theirs.fileno(), 4)))
        theirs.close()
        self.received = b""
        self.last_id = 0
        self.session = None
        self.page = Page(self)
        self.loaded = set()  # identifiers of the pages that have been loaded
        target = next(t for t in self.call("Target.getTargets")["targetInfos"] if t["type"] == "page")
        self.session = self.call("Target.attachToTarget", targetId=target["targetId"], flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.call(f"{domain}.enable")
        self.call("Page.setLifecycleEventsEnabled", enabled=True)
        self.call("Page.addScriptToEvaluateOnNewDocument", source=WITHOUT_TRANSITIONS)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()
        self.socket.close()
        self.profile.cleanup()

    def open(self, url, width):
        """Loads a page in a window of this width. Raises OSError if there is no page."""
        self.page = Page(self)
        answer = self.call("Page.navigate", url=url)
        if fault := answer.get("errorText"):
            raise OSError(f"{url}: {fault}")
        while answer["loaderId"] not in self.loaded:
            self.receive()
        self.page.resize(width)
        return self.page

    def call(self, method, **params):
        """Returns the result of a command."""
        self.last_id += 1
        command = {"id": self.last_id, "method": method, "params": params}
        if self.session:
            command["sessionId"] = self.session
        self.socket.sendall(json.dumps(command).encode() + b"\0")
        while (answer := self.receive()).get("id") != self.last_id:
            pass
        if "error" in answer:
            raise OSError(f"{method}: {answer['error']['message']}")
        return answer["result"]

    def receive(self):
        """Returns the next message of the browser, and evaluates it if it is an event."""
        while b"\0" not in self.received:
            part = self.socket.recv(1 << 20)
            if not part:
                raise OSError("Chromium has ended")
            self.received += part
        message, self.received = self.received.split(b"\0", 1)
        message = json.loads(message)
        self.note(message.get("method"), message.get("params"))
        return message

    def note(self, event, params):
        if event == "Page.lifecycleEvent" and params["name"] == "load":
            self.loaded.add(params["loaderId"])
        elif event == "Runtime.exceptionThrown":
            self.page.errors.append(text_of(params["exceptionDetails"]))
        elif event == "Log.entryAdded" and params["entry"]["level"] == "error":
            self.page.errors.append(f"{params['entry']['text']} {params['entry'].get('url', '')}".rstrip())
        elif event == "Runtime.consoleAPICalled" and params["type"] == "error":
            self.page.errors.append(" ".join(str(part.get("value", part.get("description"))) for part in params["args"]))


def text_of(details):
    thrown = details.get("exception", {}).get("description", details["text"])
    return f"{thrown.splitlines()[0]} ({details.get('url', 'script')}:{details['lineNumber'] + 1})"
