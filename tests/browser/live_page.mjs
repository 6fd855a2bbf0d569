// Opens the live page in Chromium as its readers would: with a daemon and sensors, and with a mock where no daemon could give what is
// wanted. Environment: see harness.mjs.
import { cleanUp, startDaemon } from "./daemon.mjs";
import { conclude, expect, launch } from "./harness.mjs";
import { testAccess } from "./live_access_tests.mjs";
import { testDaemon } from "./live_daemon_tests.mjs";
import { testMock } from "./live_mock_tests.mjs";

const browser = await launch();
try {
  const daemon = await startDaemon({ patch: { health: { noisy_after_s: 5 } } });
  const answer = await fetch(daemon.url);
  const kept = ["content-type", "content-security-policy"];
  const page = { body: await answer.text(), headers: Object.fromEntries(kept.map((name) => [name, answer.headers.get(name)])) };
  await testDaemon(browser, daemon);
  await testAccess(browser);
  await testMock(browser, page);
} catch (error) {
  expect(false, error.stack);
} finally {
  await browser.close();
  await cleanUp();
}
conclude();
process.exit(); // servers of a test that failed may still listen
