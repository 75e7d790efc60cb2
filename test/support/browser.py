"""A headless browser for tests of pages: Chromium by its own driver, in the protocol of WebDriver."""
import base64
import json
import os
import shutil
import socket
import subprocess
import tempfile
import time
import urllib.error
import urllib.request

PATIENCE = 60  # [s] for anything
NAMES = (('chromium', 'chromedriver'), ('chromium-browser', 'chromium.chromedriver'), ('google-chrome', 'chromedriver'))


def programs():
    """The browser and its driver; None where they are not installed: on Ubuntu 20.04 they are snaps, which no script installs."""
    return next(([shutil.which(name) for name in names] for names in NAMES if all(map(shutil.which, names))), None)


def free_port():
    with socket.socket() as listener:
        listener.bind(('127.0.0.1', 0))
        return listener.getsockname()[1]


class Browser:
    """Without network: no name is resolved. Closed by close()."""

    def __init__(self, width=1600, height=900):
        browser, driver = programs()
        self.directory = tempfile.mkdtemp()
        self.port = free_port()
        self.session = ''
        self.driver = subprocess.Popen([driver, '--port=%d' % self.port], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                       env={**os.environ, 'HOME': self.directory, 'TMPDIR': self.directory})
        try:
            self.wait_for_driver()
            arguments = ['--headless=new', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--hide-scrollbars',
                         '--host-resolver-rules=MAP * ~NOTFOUND', '--window-size=%d,%d' % (width, height)]
            options = {'goog:chromeOptions': {'binary': browser, 'args': arguments}, 'goog:loggingPrefs': {'browser': 'ALL'}}
            self.session = '/session/' + self.ask('POST', '/session', {'capabilities': {'alwaysMatch': options}})['sessionId']
        except BaseException:
            self.close()
            raise

    def wait_for_driver(self):
        late = time.monotonic() + PATIENCE
        while True:
            try:
                self.ask('GET', '/status')
                return
            except urllib.error.URLError:
                if time.monotonic() > late or self.driver.poll() is not None:
                    raise
                time.sleep(0.05)

    def close(self):
        if self.session:
            self.ask('DELETE', self.session)
        self.driver.terminate()
        self.driver.wait()
        shutil.rmtree(self.directory, ignore_errors=True)

    def ask(self, method, path, content=None):
        data = json.dumps(content).encode() if content is not None else None
        request = urllib.request.Request('http://127.0.0.1:%d%s' % (self.port, path), data, {'Content-Type': 'application/json'},
                                         method=method)
        opener = urllib.request.build_opener(urllib.request.ProxyHandler({}))
        try:
            with opener.open(request, timeout=PATIENCE) as answer:
                return json.load(answer)['value']
        except urllib.error.HTTPError as error:
            raise RuntimeError(json.load(error)['value']['message']) from error

    def open(self, file):
        self.ask('POST', self.session + '/url', {'url': 'file://' + os.path.abspath(file)})

    def run(self, code):
        """What an asynchronous function with this body returns in the page."""
        script = 'const done = arguments[0]; (async () => { %s })().then(done, (error) => done({failed: String(error)}));' % code
        value = self.ask('POST', self.session + '/execute/async', {'script': script, 'args': []})
        if isinstance(value, dict) and 'failed' in value:
            raise RuntimeError(value['failed'])
        return value

    def point_at(self, x, y, click=False):
        """Moves the pointer to a place of the page, in pixels, from a place nearby, and clicks there if asked to."""
        steps = [{'type': 'pointerMove', 'duration': 0, 'x': round(x) + 3, 'y': round(y)},
                 {'type': 'pointerMove', 'duration': 100, 'x': round(x), 'y': round(y)}]
        if click:
            steps += [{'type': 'pointerDown', 'button': 0}, {'type': 'pointerUp', 'button': 0}]
        pointer = {'type': 'pointer', 'id': 'mouse', 'parameters': {'pointerType': 'mouse'}, 'actions': steps}
        self.ask('POST', self.session + '/actions', {'actions': [pointer]})

    def complaints(self):
        """What the console has been told since the last call: errors, warnings, refused connections."""
        return [entry['message'] for entry in self.ask('POST', self.session + '/se/log', {'type': 'browser'})]

    def screenshot(self, file):
        with open(file, 'wb') as image:
            image.write(base64.b64decode(self.ask('GET', self.session + '/screenshot')))
