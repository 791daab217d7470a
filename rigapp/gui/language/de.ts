<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>rigapp</name>
    <message>
        <source> or </source>
        <translation> oder </translation>
    </message>
    <message>
        <source>% of the predicted RMS</source>
        <translation>% des vorhergesagten RMS</translation>
    </message>
    <message>
        <source>&amp;Browse…</source>
        <translation>&amp;Durchsuchen…</translation>
    </message>
    <message>
        <source>&amp;Connect</source>
        <translation>&amp;Verbinden</translation>
    </message>
    <message>
        <source>&amp;Daily check</source>
        <translation>&amp;Tägliche Prüfung</translation>
    </message>
    <message>
        <source>&amp;End fault</source>
        <translation>Fehler &amp;beenden</translation>
    </message>
    <message>
        <source>&amp;Hold</source>
        <translation>Fest&amp;halten</translation>
    </message>
    <message>
        <source>&amp;Mistake</source>
        <translation>&amp;Fehler</translation>
    </message>
    <message>
        <source>&amp;Note</source>
        <translation>&amp;Notiz</translation>
    </message>
    <message>
        <source>&amp;Pause</source>
        <translation>&amp;Pause</translation>
    </message>
    <message>
        <source>&amp;Probe 1</source>
        <translation>&amp;Wegsensor 1</translation>
    </message>
    <message>
        <source>&amp;Quantity</source>
        <translation>&amp;Größe</translation>
    </message>
    <message>
        <source>&amp;Resume</source>
        <translation>&amp;Weiter</translation>
    </message>
    <message>
        <source>&amp;Start…</source>
        <translation>&amp;Start…</translation>
    </message>
    <message>
        <source>&amp;Stop the spindle</source>
        <translation>Spindel &amp;stoppen</translation>
    </message>
    <message>
        <source>&amp;Turn the spindle</source>
        <translation>Spindel &amp;drehen</translation>
    </message>
    <message>
        <source>&amp;Zero load cell</source>
        <translation>Kraftsensor &amp;nullen</translation>
    </message>
    <message>
        <source>, 1 draft</source>
        <translation>, 1 Entwurf</translation>
    </message>
    <message>
        <source>, HELD</source>
        <translation>, FESTGEHALTEN</translation>
    </message>
    <message>
        <source>, ends {} inside</source>
        <translation>, endet {} innerhalb</translation>
    </message>
    <message>
        <source>, model {}</source>
        <translation>, Modell {}</translation>
    </message>
    <message>
        <source>, {} old</source>
        <translation>, {} alt</translation>
    </message>
    <message>
        <source>--revolutions: take at least 1; 12 are good</source>
        <translation>--revolutions: mindestens 1 nehmen; 12 sind gut</translation>
    </message>
    <message>
        <source>1 change not part of {}</source>
        <translation>1 Änderung nicht Teil von {}</translation>
    </message>
    <message>
        <source>1 mistake</source>
        <translation>1 Fehler</translation>
    </message>
    <message>
        <source>1 revolution</source>
        <translation>1 Umdrehung</translation>
    </message>
    <message>
        <source>10⁻⁶ {}; band 95 %</source>
        <translation>10⁻⁶ {}; Band 95 %</translation>
    </message>
    <message>
        <source>A test is under way. It goes on without this window.</source>
        <translation>Ein Versuch läuft. Er geht ohne dieses Fenster weiter.</translation>
    </message>
    <message>
        <source>Ac&amp;knowledge</source>
        <translation>&amp;Quittieren</translation>
    </message>
    <message>
        <source>Acceleration</source>
        <translation>Beschleunigung</translation>
    </message>
    <message>
        <source>Acknowledge</source>
        <translation>Quittieren</translation>
    </message>
    <message>
        <source>Acknowledge &quot;{}&quot; and {} more: say that you have seen it.</source>
        <translation>„{}“ und {} weitere quittieren: bestätigen, dass es gesehen wurde.</translation>
    </message>
    <message>
        <source>Acknowledge &quot;{}&quot;: say that you have seen it.</source>
        <translation>„{}“ quittieren: bestätigen, dass es gesehen wurde.</translation>
    </message>
    <message>
        <source>Acknowledge all</source>
        <translation>Alle quittieren</translation>
    </message>
    <message>
        <source>Acknowledge the chosen alarm</source>
        <translation>Den gewählten Alarm quittieren</translation>
    </message>
    <message>
        <source>Add a limit</source>
        <translation>Grenze hinzufügen</translation>
    </message>
    <message>
        <source>Add a limit that tells when the joint has changed</source>
        <translation>Eine Grenze hinzufügen, die sagt, wann sich das Gelenk geändert hat</translation>
    </message>
    <message>
        <source>Add limit</source>
        <translation>Grenze hinzufügen</translation>
    </message>
    <message>
        <source>Add note</source>
        <translation>Notiz schreiben</translation>
    </message>
    <message>
        <source>Add or discard</source>
        <translation>Hinzufügen oder verwerfen</translation>
    </message>
    <message>
        <source>Added mass</source>
        <translation>Zusatzmasse</translation>
    </message>
    <message>
        <source>After</source>
        <translation>Nachher</translation>
    </message>
    <message>
        <source>After alarm</source>
        <translation>Nach einem Alarm</translation>
    </message>
    <message>
        <source>Against</source>
        <translation>Gegen</translation>
    </message>
    <message>
        <source>Age of the prediction</source>
        <translation>Alter der Vorhersage</translation>
    </message>
    <message>
        <source>Alarm</source>
        <translation>Alarm</translation>
    </message>
    <message>
        <source>Alarms</source>
        <translation>Alarme</translation>
    </message>
    <message>
        <source>Alarms and limits</source>
        <translation>Alarme und Grenzen</translation>
    </message>
    <message>
        <source>All readings are taken. Look at the result</source>
        <translation>Alle Messungen sind genommen. Das Ergebnis ansehen</translation>
    </message>
    <message>
        <source>All revolutions are done.</source>
        <translation>Alle Umdrehungen sind gefahren.</translation>
    </message>
    <message>
        <source>An overload would be seen too late, so the drive was switched off.</source>
        <translation>Eine Überlast würde zu spät bemerkt; der Antrieb wurde abgeschaltet.</translation>
    </message>
    <message>
        <source>Angle from the contact point, follower frame</source>
        <translation>Winkel vom Berührpunkt, Bezugssystem Koppel</translation>
    </message>
    <message>
        <source>Angles of that revolution are uncertain; its row is flagged.</source>
        <translation>Die Winkel dieser Umdrehung sind unsicher; ihre Zeile ist gekennzeichnet.</translation>
    </message>
    <message>
        <source>Answer to the last command</source>
        <translation>Antwort auf den letzten Befehl</translation>
    </message>
    <message>
        <source>Apr</source>
        <translation>Apr</translation>
    </message>
    <message>
        <source>Armed test</source>
        <translation>Scharfer Versuch</translation>
    </message>
    <message>
        <source>At cycle {:.0f}</source>
        <translation>Bei Zyklus {:.0f}</translation>
    </message>
    <message>
        <source>Attaching</source>
        <translation>Suche</translation>
    </message>
    <message>
        <source>Aug</source>
        <translation>Aug</translation>
    </message>
    <message>
        <source>Axis 1</source>
        <translation>Achse 1</translation>
    </message>
    <message>
        <source>Axis 2</source>
        <translation>Achse 2</translation>
    </message>
    <message>
        <source>Axis to compare on</source>
        <translation>Achse des Vergleichs</translation>
    </message>
    <message>
        <source>Backlash is not known</source>
        <translation>Das Umkehrspiel ist nicht bekannt</translation>
    </message>
    <message>
        <source>Before</source>
        <translation>Vorher</translation>
    </message>
    <message>
        <source>Before alarm</source>
        <translation>Vor einem Alarm</translation>
    </message>
    <message>
        <source>Before the start</source>
        <translation>Vor dem Start</translation>
    </message>
    <message>
        <source>Begin or take up</source>
        <translation>Beginnen oder fortsetzen</translation>
    </message>
    <message>
        <source>Bro&amp;wse…</source>
        <translation>&amp;Durchsuchen…</translation>
    </message>
    <message>
        <source>Bushing outer radius</source>
        <translation>Außenradius der Buchse</translation>
    </message>
    <message>
        <source>Bushing radius</source>
        <translation>Innenradius der Buchse</translation>
    </message>
    <message>
        <source>Bushing width</source>
        <translation>Breite der Buchse</translation>
    </message>
    <message>
        <source>Calibrate</source>
        <translation>Kalibrieren</translation>
    </message>
    <message>
        <source>Calibrate for a known uncertainty</source>
        <translation>Kalibrieren, damit die Unsicherheit bekannt ist</translation>
    </message>
    <message>
        <source>Calibrate the cell, or correct load_cell.matrix_N_per_mV_per_V</source>
        <translation>Den Kraftsensor kalibrieren oder load_cell.matrix_N_per_mV_per_V berichtigen</translation>
    </message>
    <message>
        <source>Calibrate, or give a reason in calibration_override of the rig file</source>
        <translation>Kalibrieren oder in calibration_override der Prüfstandsdatei einen Grund angeben</translation>
    </message>
    <message>
        <source>Calibrate…  F3</source>
        <translation>Kalibrieren…  F3</translation>
    </message>
    <message>
        <source>Calibrating needs a running engine and no test under way.</source>
        <translation>Zum Kalibrieren muss die Steuerung laufen und kein Versuch im Gang sein.</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Cause</source>
        <translation>Ursache</translation>
    </message>
    <message>
        <source>Cause fa&amp;ult</source>
        <translation>Fehler &amp;auslösen</translation>
    </message>
    <message>
        <source>Cause the fault</source>
        <translation>Den Fehler auslösen</translation>
    </message>
    <message>
        <source>Chan&amp;ge limit</source>
        <translation>Grenze ä&amp;ndern</translation>
    </message>
    <message>
        <source>Change the chosen limit</source>
        <translation>Die gewählte Grenze ändern</translation>
    </message>
    <message>
        <source>Changes in Prepare are not saved: save or discard them first.</source>
        <translation>Änderungen unter Vorbereiten sind nicht gespeichert: erst speichern oder verwerfen.</translation>
    </message>
    <message>
        <source>Changes that are not saved</source>
        <translation>Änderungen, die nicht gespeichert sind</translation>
    </message>
    <message>
        <source>Changes that would be lost</source>
        <translation>Änderungen, die verloren gingen</translation>
    </message>
    <message>
        <source>Channel against crank angle</source>
        <translation>Kanal über dem Kurbelwinkel</translation>
    </message>
    <message>
        <source>Channel of a signal fault</source>
        <translation>Kanal eines Signalfehlers</translation>
    </message>
    <message>
        <source>Channels, live</source>
        <translation>Kanäle, laufend</translation>
    </message>
    <message>
        <source>Check</source>
        <translation>Prüfung</translation>
    </message>
    <message>
        <source>Check cable and power of the drive, then reconnect.</source>
        <translation>Kabel und Versorgung des Antriebs prüfen, dann neu verbinden.</translation>
    </message>
    <message>
        <source>Check cable and power, then reconnect.</source>
        <translation>Kabel und Versorgung prüfen, dann neu verbinden.</translation>
    </message>
    <message>
        <source>Check for suspend mode and load of this computer.</source>
        <translation>Ruhezustand und Last dieses Rechners prüfen.</translation>
    </message>
    <message>
        <source>Check its cable, its power and its port in the rig file.</source>
        <translation>Kabel, Versorgung und Anschluss in der Prüfstandsdatei prüfen.</translation>
    </message>
    <message>
        <source>Check plug, cable and bridge of this input, and its range in the rig file; then reset.</source>
        <translation>Stecker, Kabel und Brücke dieses Eingangs und seinen Bereich in der Prüfstandsdatei prüfen; dann zurücksetzen.</translation>
    </message>
    <message>
        <source>Check plug, cable and sensor of this input, and its range in the rig file.</source>
        <translation>Stecker, Kabel und Sensor dieses Eingangs und seinen Bereich in der Prüfstandsdatei prüfen.</translation>
    </message>
    <message>
        <source>Check sensor and wiring, or adjust the probe</source>
        <translation>Sensor und Verdrahtung prüfen oder den Wegsensor einstellen</translation>
    </message>
    <message>
        <source>Check that it is repaired, then reconnect.</source>
        <translation>Prüfen, ob es repariert ist, dann neu verbinden.</translation>
    </message>
    <message>
        <source>Check the bridge&apos;s wires, plug and cell; then reconnect and reset.</source>
        <translation>Adern der Brücke, Stecker und Sensor prüfen; dann neu verbinden und zurücksetzen.</translation>
    </message>
    <message>
        <source>Check the cable and the power of the device; then reconnect.</source>
        <translation>Kabel und Versorgung des Geräts prüfen; dann neu verbinden.</translation>
    </message>
    <message>
        <source>Check the device that tells it, or go on without</source>
        <translation>Das Gerät prüfen, das ihn meldet, oder ohne ihn fortfahren</translation>
    </message>
    <message>
        <source>Check the device, reconnect</source>
        <translation>Das Gerät prüfen, neu verbinden</translation>
    </message>
    <message>
        <source>Check the disk; start again with another file.</source>
        <translation>Die Festplatte prüfen; mit einer anderen Datei neu starten.</translation>
    </message>
    <message>
        <source>Check the drive&apos;s tuning and its encoder; then reset and start again.</source>
        <translation>Einstellung und Drehgeber des Antriebs prüfen; dann zurücksetzen und neu starten.</translation>
    </message>
    <message>
        <source>Check the drive&apos;s tuning at low speed.</source>
        <translation>Die Einstellung des Antriebs bei kleiner Drehzahl prüfen.</translation>
    </message>
    <message>
        <source>Check the encoder&apos;s cable, its supply and its coupling; then reset.</source>
        <translation>Kabel, Versorgung und Kupplung des Drehgebers prüfen; dann zurücksetzen.</translation>
    </message>
    <message>
        <source>Check the index line of the encoder and restarts_at_index in the rig file.</source>
        <translation>Die Indexleitung des Drehgebers und restarts_at_index in der Prüfstandsdatei prüfen.</translation>
    </message>
    <message>
        <source>Check the load cell&apos;s cable and the amplifier&apos;s input; then reset.</source>
        <translation>Kabel des Kraftsensors und Eingang des Verstärkers prüfen; dann zurücksetzen.</translation>
    </message>
    <message>
        <source>Check the mechanism for stiffness, the coupling, and whether the drive has switched off.</source>
        <translation>Prüfen: Schwergängigkeit der Mechanik, Kupplung, und ob der Antrieb abgeschaltet hat.</translation>
    </message>
    <message>
        <source>Check the mechanism for stiffness, the drive&apos;s current limit and its tuning.</source>
        <translation>Schwergängigkeit der Mechanik, Stromgrenze und Einstellung des Antriebs prüfen.</translation>
    </message>
    <message>
        <source>Check the probes, or the prediction&apos;s process, or stop the test.</source>
        <translation>Die Wegsensoren oder den Prozess der Vorhersage prüfen, oder den Versuch stoppen.</translation>
    </message>
    <message>
        <source>Check the sensor&apos;s wires and plug, then reconnect.</source>
        <translation>Adern und Stecker des Sensors prüfen, dann neu verbinden.</translation>
    </message>
    <message>
        <source>Checks</source>
        <translation>Prüfungen</translation>
    </message>
    <message>
        <source>Checks before the start</source>
        <translation>Prüfungen vor dem Start</translation>
    </message>
    <message>
        <source>Choose a folder that can be written to</source>
        <translation>Einen Ordner wählen, in den geschrieben werden kann</translation>
    </message>
    <message>
        <source>Choose a limit.</source>
        <translation>Eine Grenze wählen.</translation>
    </message>
    <message>
        <source>Choose a test</source>
        <translation>Versuchsdatei wählen</translation>
    </message>
    <message>
        <source>Choose another test file</source>
        <translation>Andere Versuchsdatei wählen</translation>
    </message>
    <message>
        <source>Choose one or more tests above and press Compare.</source>
        <translation>Oben einen oder mehrere Versuche wählen und Vergleichen drücken.</translation>
    </message>
    <message>
        <source>Choose test and file, then start</source>
        <translation>Versuch und Datei wählen, dann starten</translation>
    </message>
    <message>
        <source>Circle: probe 1, triangle: probe 2</source>
        <translation>Kreis: Wegsensor 1, Dreieck: Wegsensor 2</translation>
    </message>
    <message>
        <source>Click, or Tab to it and use ← →, to read values; Esc ends it.</source>
        <translation>Klicken, oder mit Tab hierher und mit ← →, um Werte zu lesen; Esc beendet es.</translation>
    </message>
    <message>
        <source>Clocks parted</source>
        <translation>Uhren laufen auseinander</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>Close other programs or lower the sample rate.</source>
        <translation>Andere Programme schließen oder die Abtastrate senken.</translation>
    </message>
    <message>
        <source>Close other programs, check the USB cable, or lower the sample rate.</source>
        <translation>Andere Programme schließen, das USB-Kabel prüfen oder die Abtastrate senken.</translation>
    </message>
    <message>
        <source>Close other programs, lower the sample rate, or take a faster computer; then reset.</source>
        <translation>Andere Programme schließen, die Abtastrate senken oder einen schnelleren Rechner nehmen; dann zurücksetzen.</translation>
    </message>
    <message>
        <source>Close the panel</source>
        <translation>Die Karte schließen</translation>
    </message>
    <message>
        <source>Close the window</source>
        <translation>Fenster schließen</translation>
    </message>
    <message>
        <source>Close the window, the test goes on</source>
        <translation>Fenster schließen, der Versuch geht weiter</translation>
    </message>
    <message>
        <source>Close, the test goes on</source>
        <translation>Schließen, Versuch geht weiter</translation>
    </message>
    <message>
        <source>Compare</source>
        <translation>Vergleichen</translation>
    </message>
    <message>
        <source>Compare with the stored revolution</source>
        <translation>Mit der gespeicherten Umdrehung vergleichen</translation>
    </message>
    <message>
        <source>Comparison of tests</source>
        <translation>Vergleich von Versuchen</translation>
    </message>
    <message>
        <source>Connect</source>
        <translation>Verbinden</translation>
    </message>
    <message>
        <source>Connect (F4); Start does it too</source>
        <translation>Verbinden (F4); der Start tut es auch</translation>
    </message>
    <message>
        <source>Connect the devices</source>
        <translation>Geräte verbinden</translation>
    </message>
    <message>
        <source>Connect the devices of the rig</source>
        <translation>Die Geräte des Prüfstands verbinden</translation>
    </message>
    <message>
        <source>Connect.</source>
        <translation>Verbinden.</translation>
    </message>
    <message>
        <source>Connecting</source>
        <translation>Verbinden</translation>
    </message>
    <message>
        <source>Connecting: finding the devices of the rig.</source>
        <translation>Verbinden: Die Geräte des Prüfstands werden gesucht.</translation>
    </message>
    <message>
        <source>Control of the test</source>
        <translation>Bedienung des Versuchs</translation>
    </message>
    <message>
        <source>Correct it</source>
        <translation>Berichtigen</translation>
    </message>
    <message>
        <source>Correct it in the form and save</source>
        <translation>Im Formular berichtigen und speichern</translation>
    </message>
    <message>
        <source>Crank angle</source>
        <translation>Kurbelwinkel</translation>
    </message>
    <message>
        <source>Crank inertia</source>
        <translation>Trägheitsmoment der Kurbel</translation>
    </message>
    <message>
        <source>Crank mass</source>
        <translation>Masse der Kurbel</translation>
    </message>
    <message>
        <source>Crank moves in the pause</source>
        <translation>Kurbel bewegt sich in der Pause</translation>
    </message>
    <message>
        <source>Crank radius</source>
        <translation>Kurbelradius</translation>
    </message>
    <message>
        <source>Current</source>
        <translation>Strom</translation>
    </message>
    <message>
        <source>Cycle</source>
        <translation>Zyklus</translation>
    </message>
    <message>
        <source>Cycle, by decades</source>
        <translation>Zyklus, nach Dekaden</translation>
    </message>
    <message>
        <source>Dark F9</source>
        <translation>Dunkel F9</translation>
    </message>
    <message>
        <source>Data age</source>
        <translation>Alter der Daten</translation>
    </message>
    <message>
        <source>Dec</source>
        <translation>Dez</translation>
    </message>
    <message>
        <source>Density</source>
        <translation>Dichte</translation>
    </message>
    <message>
        <source>Depth (µm)</source>
        <translation>Tiefe (µm)</translation>
    </message>
    <message>
        <source>Depths, and what of the bushing was seen</source>
        <translation>Tiefen, und was von der Buchse gesehen wurde</translation>
    </message>
    <message>
        <source>Deviation</source>
        <translation>Abweichung</translation>
    </message>
    <message>
        <source>Device dropped data</source>
        <translation>Gerät hat Daten verworfen</translation>
    </message>
    <message>
        <source>Devices</source>
        <translation>Geräte</translation>
    </message>
    <message>
        <source>Devices and channels</source>
        <translation>Geräte und Kanäle</translation>
    </message>
    <message>
        <source>Direction wrong</source>
        <translation>Drehrichtung falsch</translation>
    </message>
    <message>
        <source>Discard</source>
        <translation>Verwerfen</translation>
    </message>
    <message>
        <source>Discard the draft</source>
        <translation>Den Entwurf verwerfen</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>Festplatte</translation>
    </message>
    <message>
        <source>Disk slow</source>
        <translation>Festplatte langsam</translation>
    </message>
    <message>
        <source>Divided panels</source>
        <translation>Geteilte Felder</translation>
    </message>
    <message>
        <source>Do not start</source>
        <translation>Nicht starten</translation>
    </message>
    <message>
        <source>Do nothing</source>
        <translation>Nichts tun</translation>
    </message>
    <message>
        <source>Do nothing, critical</source>
        <translation>Nichts tun, kritisch</translation>
    </message>
    <message>
        <source>Do the next step</source>
        <translation>Den nächsten Schritt tun</translation>
    </message>
    <message>
        <source>Draft limit</source>
        <translation>Grenze im Entwurf</translation>
    </message>
    <message>
        <source>Draft, not yet part of the test</source>
        <translation>Entwurf, noch nicht Teil des Versuchs</translation>
    </message>
    <message>
        <source>Drive</source>
        <translation>Antrieb</translation>
    </message>
    <message>
        <source>Drive does not answer</source>
        <translation>Antrieb antwortet nicht</translation>
    </message>
    <message>
        <source>Drive fault</source>
        <translation>Störung des Antriebs</translation>
    </message>
    <message>
        <source>Drive off, warning</source>
        <translation>Antrieb aus, Warnung</translation>
    </message>
    <message>
        <source>Drive warning</source>
        <translation>Warnung des Antriebs</translation>
    </message>
    <message>
        <source>Earlier cycles cannot be shown: {}</source>
        <translation>Frühere Zyklen lassen sich nicht zeigen: {}</translation>
    </message>
    <message>
        <source>Effect</source>
        <translation>Folge</translation>
    </message>
    <message>
        <source>Elapsed time</source>
        <translation>Verstrichene Zeit</translation>
    </message>
    <message>
        <source>Emergency stop</source>
        <translation>Not-Halt</translation>
    </message>
    <message>
        <source>Enabled</source>
        <translation>Eingeschaltet</translation>
    </message>
    <message>
        <source>Encoder counts lost</source>
        <translation>Schritte des Drehgebers verloren</translation>
    </message>
    <message>
        <source>Encoder index missing</source>
        <translation>Index des Drehgebers fehlt</translation>
    </message>
    <message>
        <source>Encoder lost</source>
        <translation>Drehgeber ausgefallen</translation>
    </message>
    <message>
        <source>End the fault</source>
        <translation>Den Fehler beenden</translation>
    </message>
    <message>
        <source>End the test: controlled stop of the spindle, file closed. This is not the emergency stop</source>
        <translation>Den Versuch beenden: Die Spindel wird geführt angehalten, die Datei geschlossen. Dies ist nicht der Not-Halt</translation>
    </message>
    <message>
        <source>Ends early</source>
        <translation>Endet früher</translation>
    </message>
    <message>
        <source>Engine and window</source>
        <translation>Steuerung und Fenster</translation>
    </message>
    <message>
        <source>Engine lags behind</source>
        <translation>Steuerung kommt nicht nach</translation>
    </message>
    <message>
        <source>Engine process</source>
        <translation>Prozess der Steuerung</translation>
    </message>
    <message>
        <source>Engine too slow</source>
        <translation>Steuerung zu langsam</translation>
    </message>
    <message>
        <source>Enter records at this position (or type the micrometer&apos;s own um), r rejects, q closes</source>
        <translation>Enter nimmt an dieser Position auf (oder die um der Messschraube eingeben), r verwirft, q schließt</translation>
    </message>
    <message>
        <source>Enter records, r rejects, q closes</source>
        <translation>Enter nimmt auf, r verwirft, q schließt</translation>
    </message>
    <message>
        <source>Enter, a position in um, r or q</source>
        <translation>Enter, eine Position in um, r oder q</translation>
    </message>
    <message>
        <source>Enter, r or q</source>
        <translation>Enter, r oder q</translation>
    </message>
    <message>
        <source>Every</source>
        <translation>Jede</translation>
    </message>
    <message>
        <source>Every angle would be mirrored, or the motor run away, so the test was stopped.</source>
        <translation>Jeder Winkel wäre gespiegelt, oder der Motor ginge durch; der Versuch wurde gestoppt.</translation>
    </message>
    <message>
        <source>Every reading is saved as it is taken. You may close and go on tomorrow.</source>
        <translation>Jede Messung ist gespeichert, sobald sie genommen ist. Sie können schließen und morgen weitermachen.</translation>
    </message>
    <message>
        <source>Every sample is flagged until the devices are connected again.</source>
        <translation>Jeder Messwert ist gekennzeichnet, bis die Geräte neu verbunden sind.</translation>
    </message>
    <message>
        <source>Every window may operate the rig. In command, only this one does, apart from stopping and acknowledging</source>
        <translation>Jedes Fenster darf den Prüfstand bedienen. Mit dem Kommando darf es nur dieses, außer stoppen und quittieren</translation>
    </message>
    <message>
        <source>F&amp;ind</source>
        <translation>&amp;Finden</translation>
    </message>
    <message>
        <source>False</source>
        <translation>nein</translation>
    </message>
    <message>
        <source>Fault</source>
        <translation>Störung</translation>
    </message>
    <message>
        <source>Faults of the simulated rig</source>
        <translation>Fehler des simulierten Prüfstands</translation>
    </message>
    <message>
        <source>Feb</source>
        <translation>Feb</translation>
    </message>
    <message>
        <source>File</source>
        <translation>Datei</translation>
    </message>
    <message>
        <source>File cannot be written</source>
        <translation>Datei kann nicht geschrieben werden</translation>
    </message>
    <message>
        <source>File deleted, moved or replaced</source>
        <translation>Datei gelöscht, verschoben oder ersetzt</translation>
    </message>
    <message>
        <source>File has no name any more</source>
        <translation>Datei hat keinen Namen mehr</translation>
    </message>
    <message>
        <source>File that the test is written to</source>
        <translation>Datei, in die der Versuch geschrieben wird</translation>
    </message>
    <message>
        <source>Follow the last {} cycles</source>
        <translation>Den letzten {} Zyklen folgen</translation>
    </message>
    <message>
        <source>Follower inertia</source>
        <translation>Trägheitsmoment der Koppel</translation>
    </message>
    <message>
        <source>Follower length</source>
        <translation>Länge der Koppel</translation>
    </message>
    <message>
        <source>Follower mass</source>
        <translation>Masse der Koppel</translation>
    </message>
    <message>
        <source>Force</source>
        <translation>Kraft</translation>
    </message>
    <message>
        <source>Force against its limit</source>
        <translation>Kraft im Vergleich zu ihrer Grenze</translation>
    </message>
    <message>
        <source>Force and angle are unknown, so the drive was switched off.</source>
        <translation>Kraft und Winkel sind unbekannt; der Antrieb wurde abgeschaltet.</translation>
    </message>
    <message>
        <source>Force vector</source>
        <translation>Kraftvektor</translation>
    </message>
    <message>
        <source>Force vector over one revolution</source>
        <translation>Kraftvektor über eine Umdrehung</translation>
    </message>
    <message>
        <source>Force vector, polar</source>
        <translation>Kraftvektor, polar</translation>
    </message>
    <message>
        <source>Force {}</source>
        <translation>Kraft {}</translation>
    </message>
    <message>
        <source>Force {} (N)</source>
        <translation>Kraft {} (N)</translation>
    </message>
    <message>
        <source>Form</source>
        <translation>Formular</translation>
    </message>
    <message>
        <source>Free position</source>
        <translation>Ungespannte Lage</translation>
    </message>
    <message>
        <source>Free&amp;ze</source>
        <translation>Fest&amp;halten</translation>
    </message>
    <message>
        <source>Friction coefficient</source>
        <translation>Reibungszahl</translation>
    </message>
    <message>
        <source>Give the reason.</source>
        <translation>Den Grund angeben.</translation>
    </message>
    <message>
        <source>Gravity</source>
        <translation>Fallbeschleunigung</translation>
    </message>
    <message>
        <source>Hold off</source>
        <translation>Anfangsschonung</translation>
    </message>
    <message>
        <source>How far inside limit {} its alarm ends</source>
        <translation>Wie weit innerhalb der Grenze {} ihr Alarm endet</translation>
    </message>
    <message>
        <source>Identified</source>
        <translation>Bestimmt</translation>
    </message>
    <message>
        <source>Initial wear coefficient</source>
        <translation>Verschleißkoeffizient am Anfang</translation>
    </message>
    <message>
        <source>It should be {:.1f} {}</source>
        <translation>Es sollten {:.1f} {} sein</translation>
    </message>
    <message>
        <source>Joint force over one revolution</source>
        <translation>Gelenkkraft über eine Umdrehung</translation>
    </message>
    <message>
        <source>Journal</source>
        <translation>Verlauf</translation>
    </message>
    <message>
        <source>Journal of the alarms</source>
        <translation>Verlauf der Alarme</translation>
    </message>
    <message>
        <source>Keep this revolution in grey behind the next ones</source>
        <translation>Diese Umdrehung grau hinter den nächsten behalten</translation>
    </message>
    <message>
        <source>Keep this revolution in grey behind the next ones.</source>
        <translation>Diese Umdrehung grau hinter den nächsten behalten.</translation>
    </message>
    <message>
        <source>Last &amp;{}</source>
        <translation>Letzte &amp;{}</translation>
    </message>
    <message>
        <source>Last word of the engine</source>
        <translation>Letzte Meldung der Steuerung</translation>
    </message>
    <message>
        <source>Law</source>
        <translation>Gesetz</translation>
    </message>
    <message>
        <source>Lay the level on the flat of the crank and turn the crank until the bubble is in the middle.</source>
        <translation>Die Wasserwaage auf die Fläche der Kurbel legen und die Kurbel drehen, bis die Blase in der Mitte ist.</translation>
    </message>
    <message>
        <source>Lay the level on the flat of the crank, turn the crank until the bubble is in the middle, and enter the angle that the encoder shows. Then turn the level end for end and do it again: the mean is free of the level&apos;s own error</source>
        <translation>Die Wasserwaage auf die Fläche der Kurbel legen, die Kurbel drehen, bis die Blase in der Mitte ist, und den Winkel eingeben, den der Drehgeber zeigt. Dann die Wasserwaage umdrehen und es noch einmal tun: Das Mittel ist frei von ihrem eigenen Fehler</translation>
    </message>
    <message>
        <source>Limit {}</source>
        <translation>Grenze {}</translation>
    </message>
    <message>
        <source>Load cell</source>
        <translation>Kraftsensor</translation>
    </message>
    <message>
        <source>Longest stall</source>
        <translation>Längster Stillstand</translation>
    </message>
    <message>
        <source>Lower limits.overload_N</source>
        <translation>limits.overload_N senken</translation>
    </message>
    <message>
        <source>Lower limits.overload_N to what the cell may carry</source>
        <translation>limits.overload_N auf das senken, was der Kraftsensor tragen darf</translation>
    </message>
    <message>
        <source>Measured wear depth (µm)</source>
        <translation>Gemessene Verschleißtiefe (µm)</translation>
    </message>
    <message>
        <source>N, cycle {}</source>
        <translation>N, Zyklus {}</translation>
    </message>
    <message>
        <source>N, grey: every sample</source>
        <translation>N, grau: jeder Messwert</translation>
    </message>
    <message>
        <source>New test, not saved yet</source>
        <translation>Neuer Versuch, noch nicht gespeichert</translation>
    </message>
    <message>
        <source>No depth of wear known yet: the worn profile of the bushing is drawn here.</source>
        <translation>Noch keine Verschleißtiefe bekannt: Hier wird das verschlissene Profil der Buchse gezeichnet.</translation>
    </message>
    <message>
        <source>No prediction yet: measured − model is drawn here.</source>
        <translation>Noch keine Vorhersage: Hier wird Messung − Modell gezeichnet.</translation>
    </message>
    <message>
        <source>No revolution measured yet</source>
        <translation>Noch keine Umdrehung gemessen</translation>
    </message>
    <message>
        <source>No revolution measured yet: the force is drawn here where it points.</source>
        <translation>Noch keine Umdrehung gemessen: Hier wird die Kraft dorthin gezeichnet, wohin sie zeigt.</translation>
    </message>
    <message>
        <source>No revolution measured yet: the joint force over one turn of the crank is drawn here.</source>
        <translation>Noch keine Umdrehung gemessen: Hier wird die Gelenkkraft über eine Kurbelumdrehung gezeichnet.</translation>
    </message>
    <message>
        <source>No revolution measured yet: the wear depth with its predicted band is drawn here.</source>
        <translation>Noch keine Umdrehung gemessen: Hier wird die Verschleißtiefe mit ihrem vorhergesagten Band gezeichnet.</translation>
    </message>
    <message>
        <source>No stored revolution: {}</source>
        <translation>Keine gespeicherte Umdrehung: {}</translation>
    </message>
    <message>
        <source>No test is under way; limits are changed in the test file.</source>
        <translation>Kein Versuch ist im Gang; Grenzen werden in der Versuchsdatei geändert.</translation>
    </message>
    <message>
        <source>No value yet of {}, which the model beside the test tells.</source>
        <translation>Noch kein Wert von {}; ihn sagt das Modell neben dem Versuch.</translation>
    </message>
    <message>
        <source>No value yet of {}.</source>
        <translation>Noch kein Wert von {}.</translation>
    </message>
    <message>
        <source>Nominal pressure high</source>
        <translation>Nennpressung, obere Grenze</translation>
    </message>
    <message>
        <source>None of the chosen tests has {}.</source>
        <translation>Keiner der gewählten Versuche hat {}.</translation>
    </message>
    <message>
        <source>Not computed: {}</source>
        <translation>Nicht berechnet: {}</translation>
    </message>
    <message>
        <source>Notes</source>
        <translation>Notizen</translation>
    </message>
    <message>
        <source>Nothing is saved. Go back, select a reading of the series that is wrong, reject it with the reason, and take that series again. All readings so far stay in the journal</source>
        <translation>Nichts ist gespeichert. Zurückgehen, eine Messung der falschen Reihe wählen, sie mit dem Grund verwerfen und die Reihe wiederholen. Alle bisherigen Messungen bleiben im Journal</translation>
    </message>
    <message>
        <source>Nothing is saved. The rolls stay as they are; begin a new map when the cause is removed</source>
        <translation>Nichts ist gespeichert. Die Umläufe bleiben, wie sie sind; eine neue Karte beginnen, wenn die Ursache behoben ist</translation>
    </message>
    <message>
        <source>Nothing may hang on the pin</source>
        <translation>Am Bolzen darf nichts hängen</translation>
    </message>
    <message>
        <source>One speed only: what inertia adds to it is not known. A second, other speed tells</source>
        <translation>Nur eine Drehzahl: Was die Trägheit beiträgt, ist nicht bekannt. Eine zweite, andere Drehzahl sagt es</translation>
    </message>
    <message>
        <source>Only the first {} are compared.</source>
        <translation>Nur die ersten {} werden verglichen.</translation>
    </message>
    <message>
        <source>Open a test, or save the new one</source>
        <translation>Einen Versuch öffnen oder den neuen speichern</translation>
    </message>
    <message>
        <source>Operator</source>
        <translation>Bediener</translation>
    </message>
    <message>
        <source>Other channels over one revolution</source>
        <translation>Andere Kanäle über eine Umdrehung</translation>
    </message>
    <message>
        <source>Page</source>
        <translation>Seite</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>Pause angle</source>
        <translation>Pausenwinkel</translation>
    </message>
    <message>
        <source>Pause, warning</source>
        <translation>Pause, Warnung</translation>
    </message>
    <message>
        <source>Per decade</source>
        <translation>Je Dekade</translation>
    </message>
    <message>
        <source>Pin position</source>
        <translation>Lage des Bolzens</translation>
    </message>
    <message>
        <source>Pin radius</source>
        <translation>Radius des Bolzens</translation>
    </message>
    <message>
        <source>Poisson&apos;s ratio</source>
        <translation>Querkontraktionszahl</translation>
    </message>
    <message>
        <source>Position</source>
        <translation>Position</translation>
    </message>
    <message>
        <source>Power</source>
        <translation>Leistung</translation>
    </message>
    <message>
        <source>Practice: no waiting times</source>
        <translation>Übung: keine Wartezeiten</translation>
    </message>
    <message>
        <source>Pressure exponent</source>
        <translation>Exponent der Pressung</translation>
    </message>
    <message>
        <source>Pressure velocity high</source>
        <translation>pv-Wert, obere Grenze</translation>
    </message>
    <message>
        <source>Pressure velocity low</source>
        <translation>pv-Wert, untere Grenze</translation>
    </message>
    <message>
        <source>Prob&amp;e 2</source>
        <translation>Wegs&amp;ensor 2</translation>
    </message>
    <message>
        <source>Probe 1</source>
        <translation>Wegsensor 1</translation>
    </message>
    <message>
        <source>Probe 2</source>
        <translation>Wegsensor 2</translation>
    </message>
    <message>
        <source>Probe {}</source>
        <translation>Wegsensor {}</translation>
    </message>
    <message>
        <source>Quantity of limit {}</source>
        <translation>Größe der Grenze {}</translation>
    </message>
    <message>
        <source>RMS (N)</source>
        <translation>RMS (N)</translation>
    </message>
    <message>
        <source>RMS of {}</source>
        <translation>RMS {}</translation>
    </message>
    <message>
        <source>Raise the sample rate</source>
        <translation>Die Abtastrate erhöhen</translation>
    </message>
    <message>
        <source>Reading {} …</source>
        <translation>{} werden gelesen …</translation>
    </message>
    <message>
        <source>Reconnect all</source>
        <translation>Alle neu verbinden</translation>
    </message>
    <message>
        <source>Reconnect all devices</source>
        <translation>Alle Geräte neu verbinden</translation>
    </message>
    <message>
        <source>Reconnect this device</source>
        <translation>Dieses Gerät neu verbinden</translation>
    </message>
    <message>
        <source>Reference pressure</source>
        <translation>Bezugspressung</translation>
    </message>
    <message>
        <source>Release it at the rig</source>
        <translation>Am Prüfstand entriegeln</translation>
    </message>
    <message>
        <source>Remaining</source>
        <translation>Restliche Umdrehungen</translation>
    </message>
    <message>
        <source>Remove limit {}</source>
        <translation>Grenze {} entfernen</translation>
    </message>
    <message>
        <source>Replay of a recorded test</source>
        <translation>Wiedergabe eines aufgezeichneten Versuchs</translation>
    </message>
    <message>
        <source>Replay the whole test in a window of its own (Enter)</source>
        <translation>Den ganzen Versuch in einem eigenen Fenster abspielen (Enter)</translation>
    </message>
    <message>
        <source>Report, HTML</source>
        <translation>Bericht, HTML</translation>
    </message>
    <message>
        <source>Report, PDF</source>
        <translation>Bericht, PDF</translation>
    </message>
    <message>
        <source>Reports and tables of the test</source>
        <translation>Berichte und Tabellen des Versuchs</translation>
    </message>
    <message>
        <source>Reset the drive</source>
        <translation>Den Antrieb zurücksetzen</translation>
    </message>
    <message>
        <source>Residuals are shown from the third position on</source>
        <translation>Abweichungen erscheinen ab der dritten Position</translation>
    </message>
    <message>
        <source>Residuals are shown when two pin angles are known</source>
        <translation>Abweichungen erscheinen, wenn zwei Bolzenwinkel bekannt sind</translation>
    </message>
    <message>
        <source>Revolution {} does not have it</source>
        <translation>Umdrehung {} hat ihn nicht</translation>
    </message>
    <message>
        <source>Revolutions</source>
        <translation>Umdrehungen</translation>
    </message>
    <message>
        <source>Revolutions in a row of limit {}</source>
        <translation>Umdrehungen in Folge der Grenze {}</translation>
    </message>
    <message>
        <source>Revolutions shown</source>
        <translation>Gezeigte Umdrehungen</translation>
    </message>
    <message>
        <source>Revolutions turned</source>
        <translation>Gedrehte Umdrehungen</translation>
    </message>
    <message>
        <source>Rig file</source>
        <translation>Prüfstandsdatei</translation>
    </message>
    <message>
        <source>Rows not sent to this window</source>
        <translation>Nicht an dieses Fenster gesandte Zeilen</translation>
    </message>
    <message>
        <source>Running in</source>
        <translation>Einlauf</translation>
    </message>
    <message>
        <source>Running time</source>
        <translation>Laufzeit</translation>
    </message>
    <message>
        <source>Sample rate</source>
        <translation>Abtastrate</translation>
    </message>
    <message>
        <source>Samples</source>
        <translation>Messwerte</translation>
    </message>
    <message>
        <source>Save, or start without</source>
        <translation>Speichern oder ohne sie starten</translation>
    </message>
    <message>
        <source>Schedule</source>
        <translation>Plan</translation>
    </message>
    <message>
        <source>See the drive&apos;s manual</source>
        <translation>Im Handbuch des Antriebs nachsehen</translation>
    </message>
    <message>
        <source>See the sentence above the form</source>
        <translation>Siehe den Satz beim Formular</translation>
    </message>
    <message>
        <source>Severe wear coefficient</source>
        <translation>Verschleißkoeffizient der Hochlage</translation>
    </message>
    <message>
        <source>Show the whole test</source>
        <translation>Den ganzen Versuch zeigen</translation>
    </message>
    <message>
        <source>Side of limit {}</source>
        <translation>Seite der Grenze {}</translation>
    </message>
    <message>
        <source>Slider mass</source>
        <translation>Masse des Schiebers</translation>
    </message>
    <message>
        <source>Sliding speed high</source>
        <translation>Gleitgeschwindigkeit, obere Grenze</translation>
    </message>
    <message>
        <source>Source</source>
        <translation>Quelle</translation>
    </message>
    <message>
        <source>Speed (rpm)</source>
        <translation>Drehzahl (rpm)</translation>
    </message>
    <message>
        <source>Spread ln</source>
        <translation>Streuung von ln K</translation>
    </message>
    <message>
        <source>Stale data</source>
        <translation>Veraltete Daten</translation>
    </message>
    <message>
        <source>Stalls of this window over 50 ms</source>
        <translation>Stillstände dieses Fensters über 50 ms</translation>
    </message>
    <message>
        <source>Statistics against cycle</source>
        <translation>Kennwerte über dem Zyklus</translation>
    </message>
    <message>
        <source>Steps of the calibration</source>
        <translation>Schritte der Kalibrierung</translation>
    </message>
    <message>
        <source>Stiffness</source>
        <translation>Federrate</translation>
    </message>
    <message>
        <source>Stop, warning</source>
        <translation>Stopp, Warnung</translation>
    </message>
    <message>
        <source>Supply</source>
        <translation>Versorgung</translation>
    </message>
    <message>
        <source>Switch the drive off</source>
        <translation>Antrieb ausschalten</translation>
    </message>
    <message>
        <source>Take all weights off</source>
        <translation>Alle Gewichte abnehmen</translation>
    </message>
    <message>
        <source>Temperature</source>
        <translation>Temperatur</translation>
    </message>
    <message>
        <source>Text</source>
        <translation>Text</translation>
    </message>
    <message>
        <source>The RMS of measured less predicted |F|</source>
        <translation>Der RMS von gemessener minus vorhergesagter |F|</translation>
    </message>
    <message>
        <source>The angle reference has been taken already: begin the readings.</source>
        <translation>Der Winkelbezug ist schon genommen: Die Messungen können beginnen.</translation>
    </message>
    <message>
        <source>The cell feels</source>
        <translation>Der Kraftsensor spürt</translation>
    </message>
    <message>
        <source>The encoder is not known yet</source>
        <translation>Der Drehgeber ist noch nicht bekannt</translation>
    </message>
    <message>
        <source>The encoder should show 0 degrees, or 360. Then turn the level end for end and do it again: the mean is free of the level&apos;s own error. 0.2 degrees of a common angle error turn every force by as much, and no reading shows it. Only a level does.</source>
        <translation>Der Drehgeber sollte 0 Grad zeigen, oder 360. Dann die Wasserwaage umdrehen und es noch einmal tun: Das Mittel ist frei von ihrem eigenen Fehler. Ein gemeinsamer Winkelfehler von 0.2 Grad dreht jede Kraft um ebenso viel, und keine Messung zeigt ihn. Nur eine Wasserwaage tut es.</translation>
    </message>
    <message>
        <source>The encoder shows</source>
        <translation>Der Drehgeber zeigt</translation>
    </message>
    <message>
        <source>The file is still being read; try again.</source>
        <translation>Die Datei wird noch gelesen; noch einmal versuchen.</translation>
    </message>
    <message>
        <source>The log cannot be read: {}</source>
        <translation>Das Protokoll ist nicht lesbar: {}</translation>
    </message>
    <message>
        <source>The log is empty.</source>
        <translation>Das Protokoll ist leer.</translation>
    </message>
    <message>
        <source>The lower 95 % limit of the wear coefficient</source>
        <translation>Die untere 95-%-Grenze des Verschleißkoeffizienten</translation>
    </message>
    <message>
        <source>The lower 95 % limit of what remains</source>
        <translation>Die untere 95-%-Grenze dessen, was bleibt</translation>
    </message>
    <message>
        <source>The maximum of |F|</source>
        <translation>Das Maximum von |F|</translation>
    </message>
    <message>
        <source>The measured wear depth</source>
        <translation>Die gemessene Verschleißtiefe</translation>
    </message>
    <message>
        <source>The new value is not a number.</source>
        <translation>Der neue Wert ist keine Zahl.</translation>
    </message>
    <message>
        <source>The probe stands at</source>
        <translation>Der Wegsensor steht bei</translation>
    </message>
    <message>
        <source>The wear&apos;s departure from what was expected</source>
        <translation>Die Abweichung des Verschleißes vom Erwarteten</translation>
    </message>
    <message>
        <source>Then take all weights off</source>
        <translation>Dann alle Gewichte abnehmen</translation>
    </message>
    <message>
        <source>There is no test, so no stored revolution either.</source>
        <translation>Es gibt keinen Versuch, also auch keine gespeicherte Umdrehung.</translation>
    </message>
    <message>
        <source>There is such a limit already; change that one.</source>
        <translation>Eine solche Grenze gibt es schon; diese ändern.</translation>
    </message>
    <message>
        <source>This is a replay: what was recorded stays as it was</source>
        <translation>Das ist eine Wiedergabe: Was aufgezeichnet ist, bleibt, wie es war</translation>
    </message>
    <message>
        <source>This is the present value.</source>
        <translation>Dies ist der jetzige Wert.</translation>
    </message>
    <message>
        <source>Title</source>
        <translation>Titel</translation>
    </message>
    <message>
        <source>Too many requests are still waiting for an answer</source>
        <translation>Zu viele Anfragen warten noch auf eine Antwort</translation>
    </message>
    <message>
        <source>Transition</source>
        <translation>Übergang</translation>
    </message>
    <message>
        <source>True</source>
        <translation>ja</translation>
    </message>
    <message>
        <source>Type a number in place of {}.</source>
        <translation>Statt {} eine Zahl eingeben.</translation>
    </message>
    <message>
        <source>Type a whole number in place of {}.</source>
        <translation>Statt {} eine ganze Zahl eingeben.</translation>
    </message>
    <message>
        <source>Type the value of the limit.</source>
        <translation>Den Wert der Grenze eingeben.</translation>
    </message>
    <message>
        <source>Unit</source>
        <translation>Einheit</translation>
    </message>
    <message>
        <source>Unit and mean</source>
        <translation>Einheit und Mittelwert</translation>
    </message>
    <message>
        <source>Unit of the trend</source>
        <translation>Einheit des Verlaufs</translation>
    </message>
    <message>
        <source>Unit, and what the band is</source>
        <translation>Einheit, und was das Band ist</translation>
    </message>
    <message>
        <source>Until the final wear depth</source>
        <translation>Bis zur Endverschleißtiefe</translation>
    </message>
    <message>
        <source>Value of limit {}</source>
        <translation>Wert der Grenze {}</translation>
    </message>
    <message>
        <source>Values at the cursor</source>
        <translation>Werte am Cursor</translation>
    </message>
    <message>
        <source>Wait until no test is under way</source>
        <translation>Warten, bis kein Versuch im Gang ist</translation>
    </message>
    <message>
        <source>Wait, or start rigapp again</source>
        <translation>Warten oder rigapp neu starten</translation>
    </message>
    <message>
        <source>Warn</source>
        <translation>Warnen</translation>
    </message>
    <message>
        <source>Warn, critical</source>
        <translation>Warnen, kritisch</translation>
    </message>
    <message>
        <source>Warnings</source>
        <translation>Warnungen</translation>
    </message>
    <message>
        <source>Wear coefficient against cycle</source>
        <translation>Verschleißkoeffizient über dem Zyklus</translation>
    </message>
    <message>
        <source>Wear coefficient with limits against cycle</source>
        <translation>Verschleißkoeffizient mit Grenzen über dem Zyklus</translation>
    </message>
    <message>
        <source>Wear consistency</source>
        <translation>Stimmigkeit des Verschleißes</translation>
    </message>
    <message>
        <source>Wear depth against cycle, with bands</source>
        <translation>Verschleißtiefe über dem Zyklus, mit Bändern</translation>
    </message>
    <message>
        <source>Wear depth with its predicted band</source>
        <translation>Verschleißtiefe mit vorhergesagtem Band</translation>
    </message>
    <message>
        <source>Wear rate</source>
        <translation>Verschleißrate</translation>
    </message>
    <message>
        <source>Wear rate window</source>
        <translation>Fenster der Verschleißrate</translation>
    </message>
    <message>
        <source>What</source>
        <translation>Was</translation>
    </message>
    <message>
        <source>What a certificate is</source>
        <translation>Was ein Kalibrierschein ist</translation>
    </message>
    <message>
        <source>What a roll is</source>
        <translation>Was ein Umlauf ist</translation>
    </message>
    <message>
        <source>What is calibrated</source>
        <translation>Was kalibriert wird</translation>
    </message>
    <message>
        <source>What is kept</source>
        <translation>Was erhalten bleibt</translation>
    </message>
    <message>
        <source>What is known of the wear is being computed …</source>
        <translation>Was vom Verschleiß bekannt ist, wird berechnet …</translation>
    </message>
    <message>
        <source>What is wrong with limit {}, or its usual range</source>
        <translation>Was an Grenze {} falsch ist, oder ihr üblicher Bereich</translation>
    </message>
    <message>
        <source>What it looks like</source>
        <translation>Wie es aussieht</translation>
    </message>
    <message>
        <source>What it should be</source>
        <translation>Was es sein sollte</translation>
    </message>
    <message>
        <source>What limit {} does</source>
        <translation>Was Grenze {} bewirkt</translation>
    </message>
    <message>
        <source>What this is</source>
        <translation>Was dies ist</translation>
    </message>
    <message>
        <source>What will be done</source>
        <translation>Was getan wird</translation>
    </message>
    <message>
        <source>Who&amp;le test</source>
        <translation>&amp;Ganzer Versuch</translation>
    </message>
    <message>
        <source>Why a level</source>
        <translation>Warum eine Wasserwaage</translation>
    </message>
    <message>
        <source>Worn profile</source>
        <translation>Verschlissenes Profil</translation>
    </message>
    <message>
        <source>Worn profile of the bushing</source>
        <translation>Verschlissenes Profil der Buchse</translation>
    </message>
    <message>
        <source>Young&apos;s modulus</source>
        <translation>Elastizitätsmodul</translation>
    </message>
    <message>
        <source>a calibration that is refused is not saved</source>
        <translation>eine abgelehnte Kalibrierung wird nicht gespeichert</translation>
    </message>
    <message>
        <source>a journal starts with begin</source>
        <translation>ein Journal beginnt mit begin</translation>
    </message>
    <message>
        <source>a new test</source>
        <translation>ein neuer Versuch</translation>
    </message>
    <message>
        <source>a reading is rejected with a reason; write one</source>
        <translation>eine Messung wird mit einem Grund verworfen; einen angeben</translation>
    </message>
    <message>
        <source>a real rig</source>
        <translation>ein echter Prüfstand</translation>
    </message>
    <message>
        <source>a record for each channel</source>
        <translation>ein Kalibrierdatensatz für jeden Kanal</translation>
    </message>
    <message>
        <source>a record that is valid</source>
        <translation>ein gültiger Kalibrierdatensatz</translation>
    </message>
    <message>
        <source>a roll needs a rig file and a test file, whose mechanism tells the elastic motion: name the test file</source>
        <translation>ein Umlauf braucht eine Prüfstandsdatei und eine Versuchsdatei, deren Getriebe die elastische Bewegung sagt: die Versuchsdatei nennen</translation>
    </message>
    <message>
        <source>a simulated rig</source>
        <translation>ein simulierter Prüfstand</translation>
    </message>
    <message>
        <source>above</source>
        <translation>über</translation>
    </message>
    <message>
        <source>across</source>
        <translation>quer</translation>
    </message>
    <message>
        <source>across crank</source>
        <translation>quer zur Kurbel</translation>
    </message>
    <message>
        <source>across follower</source>
        <translation>quer zur Koppel</translation>
    </message>
    <message>
        <source>after the last one</source>
        <translation>nach der letzten</translation>
    </message>
    <message>
        <source>all readings are taken</source>
        <translation>alle Messungen sind genommen</translation>
    </message>
    <message>
        <source>along</source>
        <translation>längs</translation>
    </message>
    <message>
        <source>along crank</source>
        <translation>längs der Kurbel</translation>
    </message>
    <message>
        <source>along follower</source>
        <translation>längs der Koppel</translation>
    </message>
    <message>
        <source>along x</source>
        <translation>in x</translation>
    </message>
    <message>
        <source>along y</source>
        <translation>in y</translation>
    </message>
    <message>
        <source>angle of the maximum of {}</source>
        <translation>Winkel des Maximums {}</translation>
    </message>
    <message>
        <source>angle reference</source>
        <translation>Winkelbezug</translation>
    </message>
    <message>
        <source>archard</source>
        <translation>Archard</translation>
    </message>
    <message>
        <source>archard: the depth grows with pressure and slip, dh/ds = K p; running-in: K falls from its first to its steady value as exp(-revolutions / running-in); pressure-exponent: dh/ds = K p (p / reference pressure)^(exponent - 1), p the pressure at the spot; two-regimes: K is another one where nominal pressure times sliding speed is above the transition</source>
        <translation>Archard: die Tiefe wächst mit Pressung und Gleitweg, dh/ds = K p; Einlauf: K fällt vom ersten auf den stetigen Wert mit exp(-Umdrehungen / Einlauf); Exponent der Pressung: dh/ds = K p (p / Bezugspressung)^(Exponent - 1), p die Pressung an der Stelle; zwei Bereiche: K ist ein anderes, wo Nennpressung mal Gleitgeschwindigkeit über dem Übergang liegt</translation>
    </message>
    <message>
        <source>at the first of</source>
        <translation>beim ersten von</translation>
    </message>
    <message>
        <source>attention</source>
        <translation>Achtung</translation>
    </message>
    <message>
        <source>below</source>
        <translation>unter</translation>
    </message>
    <message>
        <source>beyond the model</source>
        <translation>jenseits des Modells</translation>
    </message>
    <message>
        <source>blocks</source>
        <translation>sperrt</translation>
    </message>
    <message>
        <source>change</source>
        <translation>Änderung</translation>
    </message>
    <message>
        <source>change nothing</source>
        <translation>nichts ändern</translation>
    </message>
    <message>
        <source>comments only</source>
        <translation>nur Kommentare</translation>
    </message>
    <message>
        <source>compares with the model</source>
        <translation>vergleicht mit dem Modell</translation>
    </message>
    <message>
        <source>constant</source>
        <translation>konstant</translation>
    </message>
    <message>
        <source>continuous</source>
        <translation>stetiger Kontakt</translation>
    </message>
    <message>
        <source>crank frame</source>
        <translation>Bezugssystem Kurbel</translation>
    </message>
    <message>
        <source>daily check</source>
        <translation>tägliche Prüfung</translation>
    </message>
    <message>
        <source>default {}</source>
        <translation>üblich {}</translation>
    </message>
    <message>
        <source>deviation from the model</source>
        <translation>Abweichung vom Modell</translation>
    </message>
    <message>
        <source>diff.</source>
        <translation>Diff.</translation>
    </message>
    <message>
        <source>do nothing</source>
        <translation>nichts tun</translation>
    </message>
    <message>
        <source>elapsed time</source>
        <translation>verstrichene Zeit</translation>
    </message>
    <message>
        <source>errors</source>
        <translation>Fehler</translation>
    </message>
    <message>
        <source>every</source>
        <translation>jeder</translation>
    </message>
    <message>
        <source>every step of the plan has been taken</source>
        <translation>jeder Schritt des Plans ist getan</translation>
    </message>
    <message>
        <source>every {}th</source>
        <translation>jeder {}.</translation>
    </message>
    <message>
        <source>extremes will be missed</source>
        <translation>Extremwerte werden verfehlt</translation>
    </message>
    <message>
        <source>follower frame</source>
        <translation>Bezugssystem Koppel</translation>
    </message>
    <message>
        <source>force</source>
        <translation>Kraft</translation>
    </message>
    <message>
        <source>force uncertainty</source>
        <translation>Unsicherheit der Kraft</translation>
    </message>
    <message>
        <source>friction coefficient</source>
        <translation>Reibungszahl</translation>
    </message>
    <message>
        <source>friction coefficient uncertainty</source>
        <translation>Unsicherheit der Reibungszahl</translation>
    </message>
    <message>
        <source>from {} on</source>
        <translation>ab {}</translation>
    </message>
    <message>
        <source>frozen</source>
        <translation>gehalten</translation>
    </message>
    <message>
        <source>global frame</source>
        <translation>festes Bezugssystem</translation>
    </message>
    <message>
        <source>in a row</source>
        <translation>in Folge</translation>
    </message>
    <message>
        <source>is falling</source>
        <translation>fällt</translation>
    </message>
    <message>
        <source>is identified beside the model</source>
        <translation>wird neben dem Modell bestimmt</translation>
    </message>
    <message>
        <source>it is not the journal of a probe calibration</source>
        <translation>es ist nicht das Journal einer Kalibrierung von Wegsensoren</translation>
    </message>
    <message>
        <source>its matrix cannot be inverted</source>
        <translation>seine Matrix ist nicht umkehrbar</translation>
    </message>
    <message>
        <source>last error: {}</source>
        <translation>letzter Fehler: {}</translation>
    </message>
    <message>
        <source>last good</source>
        <translation>letzte gute</translation>
    </message>
    <message>
        <source>left out</source>
        <translation>ausgelassen</translation>
    </message>
    <message>
        <source>limit gone: {}</source>
        <translation>Grenze entfällt: {}</translation>
    </message>
    <message>
        <source>load cell</source>
        <translation>Kraftsensor</translation>
    </message>
    <message>
        <source>logarithmic</source>
        <translation>logarithmisch</translation>
    </message>
    <message>
        <source>looking for it, or starting it</source>
        <translation>wird gesucht oder gestartet</translation>
    </message>
    <message>
        <source>looking for the engine</source>
        <translation>die Steuerung wird gesucht</translation>
    </message>
    <message>
        <source>lost samples</source>
        <translation>verlorene Messwerte</translation>
    </message>
    <message>
        <source>max</source>
        <translation>Max.</translation>
    </message>
    <message>
        <source>maximum</source>
        <translation>Maximum</translation>
    </message>
    <message>
        <source>maximum {}</source>
        <translation>Maximum {}</translation>
    </message>
    <message>
        <source>mean</source>
        <translation>Mittel</translation>
    </message>
    <message>
        <source>mean speed</source>
        <translation>mittlere Drehzahl</translation>
    </message>
    <message>
        <source>mean {}</source>
        <translation>Mittelwert {}</translation>
    </message>
    <message>
        <source>meas.</source>
        <translation>Messung</translation>
    </message>
    <message>
        <source>measured</source>
        <translation>gemessen</translation>
    </message>
    <message>
        <source>measured {}</source>
        <translation>gemessen {}</translation>
    </message>
    <message>
        <source>measured − model</source>
        <translation>Messung − Modell</translation>
    </message>
    <message>
        <source>measured − model across crank</source>
        <translation>Messung − Modell quer zur Kurbel</translation>
    </message>
    <message>
        <source>measured − model along crank</source>
        <translation>Messung − Modell längs der Kurbel</translation>
    </message>
    <message>
        <source>measured: not known</source>
        <translation>gemessen: nicht bekannt</translation>
    </message>
    <message>
        <source>measured: not known yet, cycle {}</source>
        <translation>gemessen: noch nicht bekannt, Zyklus {}</translation>
    </message>
    <message>
        <source>minimum</source>
        <translation>Minimum</translation>
    </message>
    <message>
        <source>minimum {}</source>
        <translation>Minimum {}</translation>
    </message>
    <message>
        <source>model</source>
        <translation>Modell</translation>
    </message>
    <message>
        <source>model (stale)</source>
        <translation>Modell (veraltet)</translation>
    </message>
    <message>
        <source>model {}</source>
        <translation>Modell {}</translation>
    </message>
    <message>
        <source>model ± U</source>
        <translation>Modell ± U</translation>
    </message>
    <message>
        <source>model: not known</source>
        <translation>Modell: nicht bekannt</translation>
    </message>
    <message>
        <source>needs the model&apos;s elastic approach</source>
        <translation>braucht die elastische Annäherung des Modells</translation>
    </message>
    <message>
        <source>new limit: {}</source>
        <translation>neue Grenze: {}</translation>
    </message>
    <message>
        <source>newest</source>
        <translation>neuester</translation>
    </message>
    <message>
        <source>no cycles</source>
        <translation>keine Zyklen</translation>
    </message>
    <message>
        <source>no profile is recorded: the pin&apos;s circle sunk in by the depth</source>
        <translation>kein Profil aufgezeichnet: der um die Tiefe eingesunkene Kreis des Bolzens</translation>
    </message>
    <message>
        <source>no reading has a weight on it</source>
        <translation>bei keiner Messung hängt ein Gewicht</translation>
    </message>
    <message>
        <source>no record: the numbers of the rig file count</source>
        <translation>kein Kalibrierdatensatz: es gelten die Zahlen der Prüfstandsdatei</translation>
    </message>
    <message>
        <source>no word from the engine</source>
        <translation>keine Meldung der Steuerung</translation>
    </message>
    <message>
        <source>nominal pressure</source>
        <translation>Nennpressung</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>none are coming</source>
        <translation>es kommen keine</translation>
    </message>
    <message>
        <source>not named</source>
        <translation>nicht genannt</translation>
    </message>
    <message>
        <source>not part of the test</source>
        <translation>nicht Teil des Versuchs</translation>
    </message>
    <message>
        <source>not pressed</source>
        <translation>nicht gedrückt</translation>
    </message>
    <message>
        <source>not reachable</source>
        <translation>nicht erreichbar</translation>
    </message>
    <message>
        <source>not told, most likely {} ({:.0f} %)</source>
        <translation>nicht entschieden, am ehesten {} ({:.0f} %)</translation>
    </message>
    <message>
        <source>not usable yet</source>
        <translation>noch nicht brauchbar</translation>
    </message>
    <message>
        <source>of either sign</source>
        <translation>mit beiderlei Vorzeichen</translation>
    </message>
    <message>
        <source>of the load cell, one weight at 4 pin angles</source>
        <translation>des Kraftsensors, ein Gewicht bei 4 Bolzenwinkeln</translation>
    </message>
    <message>
        <source>off</source>
        <translation>aus</translation>
    </message>
    <message>
        <source>on</source>
        <translation>ein</translation>
    </message>
    <message>
        <source>opening {}</source>
        <translation>Öffnen von {}</translation>
    </message>
    <message>
        <source>or a</source>
        <translation>oder ein</translation>
    </message>
    <message>
        <source>over</source>
        <translation>über</translation>
    </message>
    <message>
        <source>perfect</source>
        <translation>ideal</translation>
    </message>
    <message>
        <source>perfect: pin and bushing centres coincide; continuous: the pin always touches the bushing, and the clearance grows with the wear</source>
        <translation>ideal: die Mitten von Bolzen und Buchse fallen zusammen; stetiger Kontakt: der Bolzen berührt die Buchse immer, und das Spiel wächst mit dem Verschleiß</translation>
    </message>
    <message>
        <source>phase shift</source>
        <translation>Phasenverschiebung</translation>
    </message>
    <message>
        <source>pressed</source>
        <translation>gedrückt</translation>
    </message>
    <message>
        <source>pressure velocity</source>
        <translation>pv-Wert</translation>
    </message>
    <message>
        <source>pressure-exponent</source>
        <translation>Exponent der Pressung</translation>
    </message>
    <message>
        <source>probe pair</source>
        <translation>Wegsensorpaar</translation>
    </message>
    <message>
        <source>probes.run_out_cos_um has other orders for one probe than the other; give as many</source>
        <translation>probes.run_out_cos_um hat für einen Wegsensor andere Ordnungen als für den anderen; gleich viele angeben</translation>
    </message>
    <message>
        <source>quality</source>
        <translation>Güte</translation>
    </message>
    <message>
        <source>remaining revolutions</source>
        <translation>restliche Umdrehungen</translation>
    </message>
    <message>
        <source>remaining revolutions high</source>
        <translation>restliche Umdrehungen, obere Grenze</translation>
    </message>
    <message>
        <source>remaining revolutions low</source>
        <translation>restliche Umdrehungen, untere Grenze</translation>
    </message>
    <message>
        <source>rev</source>
        <translation>U</translation>
    </message>
    <message>
        <source>rig file</source>
        <translation>Prüfstandsdatei</translation>
    </message>
    <message>
        <source>rolls are missing</source>
        <translation>Umläufe fehlen</translation>
    </message>
    <message>
        <source>run-out map</source>
        <translation>Rundlaufkarte</translation>
    </message>
    <message>
        <source>running time</source>
        <translation>Laufzeit</translation>
    </message>
    <message>
        <source>running-in</source>
        <translation>Einlauf</translation>
    </message>
    <message>
        <source>samples</source>
        <translation>Messwerte</translation>
    </message>
    <message>
        <source>samples lost</source>
        <translation>verlorene Messwerte</translation>
    </message>
    <message>
        <source>seen {:.0f}° to {:.0f}°, cycle {}</source>
        <translation>gesehen {:.0f}° bis {:.0f}°, Zyklus {}</translation>
    </message>
    <message>
        <source>setting up</source>
        <translation>Einrichten</translation>
    </message>
    <message>
        <source>sliding speed</source>
        <translation>Gleitgeschwindigkeit</translation>
    </message>
    <message>
        <source>slow roll</source>
        <translation>langsamer Umlauf</translation>
    </message>
    <message>
        <source>slow roll of the pin</source>
        <translation>langsamer Umlauf des Bolzens</translation>
    </message>
    <message>
        <source>speed</source>
        <translation>Drehzahl</translation>
    </message>
    <message>
        <source>standard deviations</source>
        <translation>Standardabweichungen</translation>
    </message>
    <message>
        <source>still changing</source>
        <translation>ändert sich noch</translation>
    </message>
    <message>
        <source>still moving</source>
        <translation>bewegt sich noch</translation>
    </message>
    <message>
        <source>stop.remaining_revolutions needs stop.wear_depth_um, the depth to which they remain</source>
        <translation>stop.remaining_revolutions braucht stop.wear_depth_um, die Tiefe, bis zu der sie bleiben</translation>
    </message>
    <message>
        <source>stored</source>
        <translation>gespeichert</translation>
    </message>
    <message>
        <source>swinging: wait until it hangs still</source>
        <translation>schwingt: warten, bis es ruhig hängt</translation>
    </message>
    <message>
        <source>the angle is not known yet: turn the crank by hand once past the encoder&apos;s index</source>
        <translation>der Winkel ist noch nicht bekannt: die Kurbel von Hand einmal über den Index des Drehgebers drehen</translation>
    </message>
    <message>
        <source>the angle reference is entered, not recorded</source>
        <translation>der Winkelbezug wird eingegeben, nicht aufgenommen</translation>
    </message>
    <message>
        <source>the angle reference must be two finite numbers</source>
        <translation>der Winkelbezug sind zwei endliche Zahlen</translation>
    </message>
    <message>
        <source>the calibration in use is not known; is the engine running?</source>
        <translation>die verwendete Kalibrierung ist nicht bekannt; läuft die Steuerung?</translation>
    </message>
    <message>
        <source>the crank stands</source>
        <translation>die Kurbel steht</translation>
    </message>
    <message>
        <source>the crank turns</source>
        <translation>die Kurbel dreht sich</translation>
    </message>
    <message>
        <source>the crank turns; it must stand</source>
        <translation>die Kurbel dreht sich; sie muss stehen</translation>
    </message>
    <message>
        <source>the crank turns; let it stand</source>
        <translation>die Kurbel dreht sich; sie stehen lassen</translation>
    </message>
    <message>
        <source>the journal is empty</source>
        <translation>das Journal ist leer</translation>
    </message>
    <message>
        <source>the order of the limits</source>
        <translation>die Reihenfolge der Grenzen</translation>
    </message>
    <message>
        <source>the parameter file&apos;s order of magnitude, a decade to either side</source>
        <translation>die Größenordnung der Parameterdatei, eine Dekade nach beiden Seiten</translation>
    </message>
    <message>
        <source>the probes are 1, 2, or both</source>
        <translation>die Wegsensoren sind 1, 2 oder beide</translation>
    </message>
    <message>
        <source>the reach of the micrometer is a length above 0</source>
        <translation>der Weg der Messschraube ist eine Länge über 0</translation>
    </message>
    <message>
        <source>the signal is not a number</source>
        <translation>das Signal ist keine Zahl</translation>
    </message>
    <message>
        <source>the speed changes faster than the prediction can follow</source>
        <translation>die Drehzahl ändert sich schneller, als die Vorhersage folgen kann</translation>
    </message>
    <message>
        <source>the weight hung along one axis only; hang it at angles of both</source>
        <translation>das Gewicht hing nur längs einer Achse; es bei Winkeln beider anhängen</translation>
    </message>
    <message>
        <source>the zero needs samples, and none came; check the device</source>
        <translation>der Nullpunkt braucht Messwerte, und es kamen keine; das Gerät prüfen</translation>
    </message>
    <message>
        <source>there are no readings to take up; begin a calibration</source>
        <translation>es gibt keine Messungen fortzusetzen; eine Kalibrierung beginnen</translation>
    </message>
    <message>
        <source>there are no rolls to take up; begin a map</source>
        <translation>es gibt keine Umläufe fortzusetzen; eine Karte beginnen</translation>
    </message>
    <message>
        <source>there is no daily check to keep</source>
        <translation>es gibt keine tägliche Prüfung aufzubewahren</translation>
    </message>
    <message>
        <source>this reading is rejected already</source>
        <translation>diese Messung ist schon verworfen</translation>
    </message>
    <message>
        <source>this step cannot be left out</source>
        <translation>dieser Schritt kann nicht ausgelassen werden</translation>
    </message>
    <message>
        <source>too few</source>
        <translation>zu wenige</translation>
    </message>
    <message>
        <source>too much</source>
        <translation>zu viel</translation>
    </message>
    <message>
        <source>two-regimes</source>
        <translation>zwei Bereiche</translation>
    </message>
    <message>
        <source>uncertainty of the reference</source>
        <translation>Unsicherheit der Referenz</translation>
    </message>
    <message>
        <source>uncertainty of the sensitivity</source>
        <translation>Unsicherheit der Empfindlichkeit</translation>
    </message>
    <message>
        <source>uncertainty of the wear depth</source>
        <translation>Unsicherheit der Verschleißtiefe</translation>
    </message>
    <message>
        <source>unfollowed acceleration</source>
        <translation>nicht gefolgte Beschleunigung</translation>
    </message>
    <message>
        <source>usual {:.4g} to {:.4g} {}</source>
        <translation>üblich {:.4g} bis {:.4g} {}</translation>
    </message>
    <message>
        <source>waiting for samples</source>
        <translation>wartet auf Messwerte</translation>
    </message>
    <message>
        <source>warn</source>
        <translation>warnen</translation>
    </message>
    <message>
        <source>wear change revolution</source>
        <translation>Umdrehung der Änderung des Verschleißes</translation>
    </message>
    <message>
        <source>wear coefficient</source>
        <translation>Verschleißkoeffizient</translation>
    </message>
    <message>
        <source>wear coefficient high</source>
        <translation>Verschleißkoeffizient, obere Grenze</translation>
    </message>
    <message>
        <source>wear coefficient low</source>
        <translation>Verschleißkoeffizient, untere Grenze</translation>
    </message>
    <message>
        <source>wear consistency</source>
        <translation>Stimmigkeit des Verschleißes</translation>
    </message>
    <message>
        <source>wear departure revolution</source>
        <translation>Umdrehung, seit der es anders verschleißt</translation>
    </message>
    <message>
        <source>wear depth</source>
        <translation>Verschleißtiefe</translation>
    </message>
    <message>
        <source>wear depth of the model</source>
        <translation>Verschleißtiefe des Modells</translation>
    </message>
    <message>
        <source>wear depth of the model by the measured force</source>
        <translation>Verschleißtiefe des Modells aus der gemessenen Kraft</translation>
    </message>
    <message>
        <source>wear model</source>
        <translation>Verschleißmodell</translation>
    </message>
    <message>
        <source>wear model weight</source>
        <translation>Wahrscheinlichkeit des Verschleißmodells</translation>
    </message>
    <message>
        <source>wear rate</source>
        <translation>Verschleißrate</translation>
    </message>
    <message>
        <source>weights: none are named; write for example 5x8, 2, 2, 1, 0.5</source>
        <translation>Gewichte: keine genannt; zum Beispiel 5x8, 2, 2, 1, 0.5 schreiben</translation>
    </message>
    <message>
        <source>what is known of the wear coefficient is drawn here.</source>
        <translation>Hier wird gezeichnet, was vom Verschleißkoeffizienten bekannt ist.</translation>
    </message>
    <message>
        <source>wrong</source>
        <translation>falsch</translation>
    </message>
    <message>
        <source>{:.1f} N at {:.0f}°</source>
        <translation>{:.1f} N bei {:.0f}°</translation>
    </message>
    <message>
        <source>{:.1f} s ago</source>
        <translation>vor {:.1f} s</translation>
    </message>
    <message>
        <source>{:.2f} of {:.2f} rpm</source>
        <translation>{:.2f} von {:.2f} rpm</translation>
    </message>
    <message>
        <source>{:.2f} to {:.2f} (95 %)</source>
        <translation>{:.2f} bis {:.2f} (95 %)</translation>
    </message>
    <message>
        <source>{action} when {quantity} is {side} {value} in {revolutions} revolutions</source>
        <translation>{action} bei {quantity} {side} {value} in {revolutions} Umdrehungen</translation>
    </message>
    <message>
        <source>{note} ends {back} inside</source>
        <translation>{note} endet {back} innerhalb</translation>
    </message>
    <message>
        <source>{value} can never come: the drive goes off at {most}. Type a value below that.</source>
        <translation>{value} kann nie eintreten: Der Antrieb geht bei {most} aus. Einen Wert darunter eingeben.</translation>
    </message>
    <message>
        <source>{} (copy)</source>
        <translation>{} (Kopie)</translation>
    </message>
    <message>
        <source>{} a decade</source>
        <translation>{} je Dekade</translation>
    </message>
    <message>
        <source>{} above {}</source>
        <translation>{} über {}</translation>
    </message>
    <message>
        <source>{} against cycle is drawn here.</source>
        <translation>Hier wird {} über dem Zyklus gezeichnet.</translation>
    </message>
    <message>
        <source>{} at least {}, {}</source>
        <translation>{}, mindestens {}, {}</translation>
    </message>
    <message>
        <source>{} at {:g} rpm</source>
        <translation>{} bei {:g} rpm</translation>
    </message>
    <message>
        <source>{} at {}</source>
        <translation>{} bei {}</translation>
    </message>
    <message>
        <source>{} below {}</source>
        <translation>{} unter {}</translation>
    </message>
    <message>
        <source>{} changes not part of {}</source>
        <translation>{} Änderungen nicht Teil von {}</translation>
    </message>
    <message>
        <source>{} is missing</source>
        <translation>{} fehlt</translation>
    </message>
    <message>
        <source>{} is missing; type {}</source>
        <translation>{} fehlt; einzugeben: {}</translation>
    </message>
    <message>
        <source>{} less means {}</source>
        <translation>{} weniger Mittelwerte {}</translation>
    </message>
    <message>
        <source>{} maximum</source>
        <translation>{} Maximum</translation>
    </message>
    <message>
        <source>{} mistakes</source>
        <translation>{} Fehler</translation>
    </message>
    <message>
        <source>{} must be a number, not {}</source>
        <translation>{} muss eine Zahl sein, nicht {}</translation>
    </message>
    <message>
        <source>{} must be a whole number, not {}</source>
        <translation>{} muss eine ganze Zahl sein, nicht {}</translation>
    </message>
    <message>
        <source>{} must be two numbers, not {}</source>
        <translation>{} müssen zwei Zahlen sein, nicht {}</translation>
    </message>
    <message>
        <source>{} of the limits cannot be used.</source>
        <translation>{} der Grenzen sind nicht brauchbar.</translation>
    </message>
    <message>
        <source>{} of {} lines</source>
        <translation>{} von {} Zeilen</translation>
    </message>
    <message>
        <source>{} of {}, {}</source>
        <translation>{} von {}, {}</translation>
    </message>
    <message>
        <source>{} old</source>
        <translation>{} alt</translation>
    </message>
    <message>
        <source>{} over one turn of the crank is drawn here.</source>
        <translation>Hier wird {} über eine Kurbelumdrehung gezeichnet.</translation>
    </message>
    <message>
        <source>{} revolutions</source>
        <translation>{} Umdrehungen</translation>
    </message>
    <message>
        <source>{} to {}</source>
        <translation>{} bis {}</translation>
    </message>
    <message>
        <source>{} to {} revolutions (95 %)</source>
        <translation>{} bis {} Umdrehungen (95 %)</translation>
    </message>
    <message>
        <source>{} was changed by another program since it was opened. Save it as another file, or open it again, which loses what was changed here.</source>
        <translation>{} wurde seit dem Öffnen von einem anderen Programm geändert. Als andere Datei speichern oder neu öffnen; dabei geht verloren, was hier geändert wurde.</translation>
    </message>
    <message>
        <source>{} when {} is above</source>
        <translation>{} bei {} über</translation>
    </message>
    <message>
        <source>{} when {} is below</source>
        <translation>{} bei {} unter</translation>
    </message>
    <message>
        <source>{} {} in {}</source>
        <translation>{} {} in {}</translation>
    </message>
    <message>
        <source>{}, mean {}</source>
        <translation>{}, Mittelwert {}</translation>
    </message>
    <message>
        <source>{}: no whole cycle is saved yet</source>
        <translation>{}: noch kein ganzer Zyklus gespeichert</translation>
    </message>
    <message>
        <source>|F|, any sample</source>
        <translation>|F|, jeder Messwert</translation>
    </message>
    <message>
        <source>µm per 1000 rev</source>
        <translation>µm je 1000 U</translation>
    </message>
    <message>
        <source>Δ model</source>
        <translation>Δ Modell</translation>
    </message>
    <message>
        <source>= {} s by the clock, at × {}</source>
        <translation>= {} s nach der Uhr, bei × {}</translation>
    </message>
    <message>
        <source>
9.81 m/s² is a rounded value, up to 0.3 % off: write the gravity of this place, or name a settings file with latitude and height.</source>
        <translation>
9.81 m/s² ist ein gerundeter Wert, bis zu 0.3 % falsch: die Fallbeschleunigung dieses Orts eintragen oder eine Einstellungsdatei mit Breite und Höhe nennen.</translation>
    </message>
    <message>
        <source> (By cycle {}.)</source>
        <translation> (Bis Zyklus {}.)</translation>
    </message>
    <message>
        <source> ({} mistakes; each stands at its field)</source>
        <translation> ({} Fehler; jeder steht an seinem Feld)</translation>
    </message>
    <message>
        <source> Each page is marked {}.</source>
        <translation> Jede Seite ist mit {} gekennzeichnet.</translation>
    </message>
    <message>
        <source> It was made on a simulated rig, for practice.</source>
        <translation> Er entstand zur Übung an einem simulierten Prüfstand.</translation>
    </message>
    <message>
        <source> One draft limit is not part of it.</source>
        <translation> Eine Grenze im Entwurf gehört nicht dazu.</translation>
    </message>
    <message>
        <source> With both probes the stage moves along the follower first, then across it.</source>
        <translation> Bei beiden Wegsensoren fährt der Tisch erst längs, dann quer zur Koppel.</translation>
    </message>
    <message>
        <source> With one speed only, what inertia adds to the run-out is not known.</source>
        <translation> Mit nur einer Drehzahl ist nicht bekannt, was die Trägheit zum Rundlauf beiträgt.</translation>
    </message>
    <message>
        <source> and </source>
        <translation> und </translation>
    </message>
    <message>
        <source>&amp;Back</source>
        <translation>&amp;Zurück</translation>
    </message>
    <message>
        <source>&amp;Begin or take up</source>
        <translation>&amp;Beginnen oder fortsetzen</translation>
    </message>
    <message>
        <source>&amp;Both probes</source>
        <translation>&amp;Beide Wegsensoren</translation>
    </message>
    <message>
        <source>&amp;Calibrate</source>
        <translation>&amp;Kalibrieren</translation>
    </message>
    <message>
        <source>&amp;Do this step</source>
        <translation>&amp;Diesen Schritt tun</translation>
    </message>
    <message>
        <source>&amp;Encoder shows</source>
        <translation>&amp;Drehgeber zeigt</translation>
    </message>
    <message>
        <source>&amp;Finish</source>
        <translation>&amp;Fertig</translation>
    </message>
    <message>
        <source>&amp;Forget the first angle</source>
        <translation>Den ersten Winkel &amp;vergessen</translation>
    </message>
    <message>
        <source>&amp;Go on with it</source>
        <translation>Damit &amp;fortfahren</translation>
    </message>
    <message>
        <source>&amp;Go on with this one…</source>
        <translation>Damit &amp;fortfahren…</translation>
    </message>
    <message>
        <source>&amp;Hanger</source>
        <translation>&amp;Gehänge</translation>
    </message>
    <message>
        <source>&amp;Keep this angle; I turn the level end for end</source>
        <translation>Diesen Winkel &amp;behalten; ich drehe die Wasserwaage um</translation>
    </message>
    <message>
        <source>&amp;Load cell</source>
        <translation>&amp;Kraftsensor</translation>
    </message>
    <message>
        <source>&amp;Look again</source>
        <translation>&amp;Neu lesen</translation>
    </message>
    <message>
        <source>&amp;Next</source>
        <translation>&amp;Weiter</translation>
    </message>
    <message>
        <source>&amp;Operator</source>
        <translation>&amp;Bediener</translation>
    </message>
    <message>
        <source>&amp;Plan</source>
        <translation>&amp;Plan</translation>
    </message>
    <message>
        <source>&amp;Record</source>
        <translation>&amp;Aufnehmen</translation>
    </message>
    <message>
        <source>&amp;Report</source>
        <translation>&amp;Bericht</translation>
    </message>
    <message>
        <source>&amp;Run-out of the pin</source>
        <translation>&amp;Rundlauf des Bolzens</translation>
    </message>
    <message>
        <source>&amp;Settings file</source>
        <translation>&amp;Einstellungsdatei</translation>
    </message>
    <message>
        <source>Start the &amp;queue</source>
        <translation>Warteschlange &amp;beginnen</translation>
    </message>
    <message>
        <source>&amp;Take the encoder&apos;s angle as it is now</source>
        <translation>Den Winkel des Drehgebers nehmen, wie er &amp;jetzt ist</translation>
    </message>
    <message>
        <source>
| Key | Does |
| --- | --- |
{commands}
| F8 | Go to the line for reasons and notes; Enter adds the note to the log |
| F7 | Acknowledge the alarm that is told in full; show the alarms where none is seen |
| {recover} | Do the next step of the *Recover* panel |
| F1 | This help |
| F3 | Calibrate the load cell or the probes, map the pin&apos;s run-out |
| F9 | Light or dark |
| Ctrl+1 … Ctrl+9, Ctrl+0, Ctrl+D, Ctrl+R, Ctrl+U, Ctrl+W | Go to a page |
| Alt + underlined letter | Press a button, go to a field |
| ← → + − in a trend | Move and zoom; a click reads the values at a cycle, Esc the newest again |
| ← → in a force plot | Move the cursor by 1 deg, with Shift by 10 deg; a click puts it there |
| Esc | Close the start bar or this window |

The emergency stop is the red button on the rig. It works without this program, and no program
replaces it. &quot;Stop test&quot; ends a test in order: the spindle runs down, the file is closed.
</source>
        <translation>
| Taste | Wirkung |
| --- | --- |
{commands}
| F8 | Zur Zeile für Gründe und Notizen; Enter schreibt die Notiz ins Protokoll |
| F7 | Den Alarm quittieren, der ganz dasteht; ist keiner zu sehen, die Alarme zeigen |
| {recover} | Den nächsten Schritt unter *Zurück zum Versuch* tun |
| F1 | Diese Hilfe |
| F3 | Kraftsensor oder Wegsensoren kalibrieren, Rundlauf des Bolzens aufnehmen |
| F9 | Hell oder dunkel |
| Strg+1 … Strg+9, Strg+0, Strg+D, Strg+R, Strg+U, Strg+W | Zu einer Seite |
| Alt + unterstrichener Buchstabe | Eine Taste drücken, in ein Feld gehen |
| ← → + − in einem Verlauf | Verschieben und vergrößern; ein Klick liest die Werte eines Zyklus, Esc wieder die neuesten |
| ← → in einem Kraftbild | Den Cursor um 1°, mit Umschalt um 10° verschieben; ein Klick setzt ihn |
| Esc | Die Startkarte oder dieses Fenster schließen |

Der Not-Halt ist der rote Taster am Prüfstand. Er wirkt ohne dieses Programm, und kein Programm
ersetzt ihn. „Stopp“ beendet einen Versuch geordnet: Die Spindel läuft aus, die Datei wird geschlossen.
</translation>
    </message>
    <message>
        <source>&amp;Guide</source>
        <translation>&amp;Anleitung</translation>
    </message>
    <message>
        <source>&amp;Keys</source>
        <translation>&amp;Tasten</translation>
    </message>
    <message>
        <source>&amp;Test file</source>
        <translation>&amp;Versuchsdatei</translation>
    </message>
    <message>
        <source>&amp;Yes, write it</source>
        <translation>&amp;Ja, eintragen</translation>
    </message>
    <message>
        <source>, in step {}</source>
        <translation>, in Schritt {}</translation>
    </message>
    <message>
        <source>1 check</source>
        <translation>1 Prüfung</translation>
    </message>
    <message>
        <source>1: the error is within the tolerance</source>
        <translation>1: der Fehler liegt innerhalb der Toleranz</translation>
    </message>
    <message>
        <source>1: the true coefficient lies within its limits</source>
        <translation>1: der wahre Koeffizient liegt in seinen Grenzen</translation>
    </message>
    <message>
        <source>; and {} more</source>
        <translation>; und {} weitere</translation>
    </message>
    <message>
        <source>= {} s simulated, at × {}</source>
        <translation>= {} s simuliert, bei × {}</translation>
    </message>
    <message>
        <source>A complete test is over; prepare another one with New specimen</source>
        <translation>Ein vollständiger Versuch ist zu Ende; mit Neue Probe wird der nächste vorbereitet</translation>
    </message>
    <message>
        <source>A micrometer moves the target in equal steps, up and down; the voltage is read at each step. Every reading is saved at once: close at any time and take it up again.</source>
        <translation>Eine Messschraube verschiebt das Ziel in gleichen Schritten auf und ab; bei jedem wird die Spannung gelesen. Jede Messung ist sofort gespeichert: jederzeit schließen und später fortsetzen.</translation>
    </message>
    <message>
        <source>A new one, or one like another.</source>
        <translation>Einen neuen oder einen wie zuvor.</translation>
    </message>
    <message>
        <source>A recorded test is played: no rig is moved</source>
        <translation>Ein aufgezeichneter Versuch wird abgespielt: kein Prüfstand bewegt sich</translation>
    </message>
    <message>
        <source>A short test on a rig of software.</source>
        <translation>Ein kurzer Versuch, alles nur simuliert.</translation>
    </message>
    <message>
        <source>A test was cut off</source>
        <translation>Ein Versuch wurde unterbrochen</translation>
    </message>
    <message>
        <source>A wear coefficient other than the model&apos;s is seen after so many revolutions by so great a share of the tests:</source>
        <translation>Ein anderer Verschleißkoeffizient als der des Modells wird nach so vielen Umdrehungen von einem so großen Anteil der Versuche gesehen:</translation>
    </message>
    <message>
        <source>A window with the simulated rig is being opened.</source>
        <translation>Ein Fenster mit dem simulierten Prüfstand wird geöffnet.</translation>
    </message>
    <message>
        <source>A&amp;dd test files…</source>
        <translation>Versuchsdateien &amp;hinzufügen…</translation>
    </message>
    <message>
        <source>Accepted</source>
        <translation>Angenommen</translation>
    </message>
    <message>
        <source>Acknowledge the alarm that is told in full</source>
        <translation>Den Alarm quittieren, der ganz zu lesen ist</translation>
    </message>
    <message>
        <source>Action critical</source>
        <translation>Aktion, kritisch</translation>
    </message>
    <message>
        <source>Action warning</source>
        <translation>Aktion bei Warnung</translation>
    </message>
    <message>
        <source>Add a step</source>
        <translation>Schritt hinzufügen</translation>
    </message>
    <message>
        <source>After how many revolutions it is seen</source>
        <translation>Nach wie vielen Umdrehungen man es sieht</translation>
    </message>
    <message>
        <source>All</source>
        <translation>Alle</translation>
    </message>
    <message>
        <source>All results</source>
        <translation>Alle Ergebnisse</translation>
    </message>
    <message>
        <source>All rolls are recorded.</source>
        <translation>Alle Umläufe sind aufgezeichnet.</translation>
    </message>
    <message>
        <source>All steps are done.</source>
        <translation>Alle Schritte sind getan.</translation>
    </message>
    <message>
        <source>All {} results</source>
        <translation>Alle {} Ergebnisse</translation>
    </message>
    <message>
        <source>Alone</source>
        <translation>Allein</translation>
    </message>
    <message>
        <source>Always watched</source>
        <translation>Immer überwacht</translation>
    </message>
    <message>
        <source>Angle (deg)</source>
        <translation>Winkel (deg)</translation>
    </message>
    <message>
        <source>Angle reference</source>
        <translation>Winkelbezug</translation>
    </message>
    <message>
        <source>Angle that the encoder shows</source>
        <translation>Winkel, den der Drehgeber zeigt</translation>
    </message>
    <message>
        <source>As in the file.</source>
        <translation>Wie in der Datei.</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Zurück</translation>
    </message>
    <message>
        <source>Began</source>
        <translation>Beginn</translation>
    </message>
    <message>
        <source>Begin &amp;readings</source>
        <translation>&amp;Messungen beginnen</translation>
    </message>
    <message>
        <source>Begin a new calibration</source>
        <translation>Eine neue Kalibrierung beginnen</translation>
    </message>
    <message>
        <source>Begin readings</source>
        <translation>Messungen beginnen</translation>
    </message>
    <message>
        <source>Begin the next test, or go on with the one that stopped</source>
        <translation>Den nächsten Versuch beginnen oder den stehen gebliebenen fortsetzen</translation>
    </message>
    <message>
        <source>Both probes, and how they stand to each other</source>
        <translation>Beide Wegsensoren, und wie sie zueinander stehen</translation>
    </message>
    <message>
        <source>Bushing</source>
        <translation>Buchse</translation>
    </message>
    <message>
        <source>Calculating …</source>
        <translation>Wird berechnet …</translation>
    </message>
    <message>
        <source>Calibrate {}</source>
        <translation>{} kalibrieren</translation>
    </message>
    <message>
        <source>Calibrate {} – rigapp</source>
        <translation>{} kalibrieren – rigapp</translation>
    </message>
    <message>
        <source>Calibrate – rigapp</source>
        <translation>Kalibrieren – rigapp</translation>
    </message>
    <message>
        <source>Calibration</source>
        <translation>Kalibrierung</translation>
    </message>
    <message>
        <source>Calibration of {}</source>
        <translation>Kalibrierung: {}</translation>
    </message>
    <message>
        <source>Cannot be read</source>
        <translation>Nicht lesbar</translation>
    </message>
    <message>
        <source>Certificate</source>
        <translation>Kalibrierschein</translation>
    </message>
    <message>
        <source>Changed</source>
        <translation>Geändert</translation>
    </message>
    <message>
        <source>Channel</source>
        <translation>Kanal</translation>
    </message>
    <message>
        <source>Channel (signal faults)</source>
        <translation>Kanal (Signalfehler)</translation>
    </message>
    <message>
        <source>Channels</source>
        <translation>Kanäle</translation>
    </message>
    <message>
        <source>Choose a settings file</source>
        <translation>Eine Einstellungsdatei wählen</translation>
    </message>
    <message>
        <source>Choose a study: its points are drawn here.</source>
        <translation>Eine Studie wählen: hier werden ihre Punkte gezeichnet.</translation>
    </message>
    <message>
        <source>Choose a test: what it came to stands here.</source>
        <translation>Einen Versuch wählen: sein Ergebnis steht hier.</translation>
    </message>
    <message>
        <source>Choose settings</source>
        <translation>Einstellungen wählen</translation>
    </message>
    <message>
        <source>Choose tests</source>
        <translation>Versuche wählen</translation>
    </message>
    <message>
        <source>Close the comparison</source>
        <translation>Vergleich schließen</translation>
    </message>
    <message>
        <source>Close; all readings are kept</source>
        <translation>Schließen; alle Messungen bleiben erhalten</translation>
    </message>
    <message>
        <source>Closed</source>
        <translation>Abgeschlossen</translation>
    </message>
    <message>
        <source>Co&amp;mpare</source>
        <translation>&amp;Vergleichen</translation>
    </message>
    <message>
        <source>Co&amp;mpare…</source>
        <translation>&amp;Vergleichen…</translation>
    </message>
    <message>
        <source>Compare it with the newest tests of its title</source>
        <translation>Mit den neuesten Versuchen dieses Titels vergleichen</translation>
    </message>
    <message>
        <source>Complete</source>
        <translation>Vollständig</translation>
    </message>
    <message>
        <source>Computes</source>
        <translation>Berechnet</translation>
    </message>
    <message>
        <source>Connected</source>
        <translation>Verbunden</translation>
    </message>
    <message>
        <source>Connecting, {} of {} done</source>
        <translation>Verbinden, {} von {} erledigt</translation>
    </message>
    <message>
        <source>Connection of the rig</source>
        <translation>Verbindung des Prüfstands</translation>
    </message>
    <message>
        <source>Crank angle (degrees)</source>
        <translation>Kurbelwinkel (Grad)</translation>
    </message>
    <message>
        <source>Critical above</source>
        <translation>Kritisch über</translation>
    </message>
    <message>
        <source>Critical below</source>
        <translation>Kritisch unter</translation>
    </message>
    <message>
        <source>Cross-talk of axis 1 by a force along 2</source>
        <translation>Übersprechen auf Achse 1 durch eine Kraft längs Achse 2</translation>
    </message>
    <message>
        <source>Cross-talk of axis 2 by a force along 1</source>
        <translation>Übersprechen auf Achse 2 durch eine Kraft längs Achse 1</translation>
    </message>
    <message>
        <source>Cycles</source>
        <translation>Zyklen</translation>
    </message>
    <message>
        <source>Daily check: one weight at 4 pin angles</source>
        <translation>Tägliche Prüfung: ein Gewicht bei 4 Bolzenwinkeln</translation>
    </message>
    <message>
        <source>Data are missing or doubtful</source>
        <translation>Daten fehlen oder sind zweifelhaft</translation>
    </message>
    <message>
        <source>Delay</source>
        <translation>Verzögerung</translation>
    </message>
    <message>
        <source>Depends most on {}. Shares of the variance, with 95 % limits:</source>
        <translation>Hängt am meisten von {} ab. Anteile an der Varianz, mit 95-%-Grenzen:</translation>
    </message>
    <message>
        <source>Depth, µm</source>
        <translation>Tiefe, µm</translation>
    </message>
    <message>
        <source>Details</source>
        <translation>Einzelheiten</translation>
    </message>
    <message>
        <source>Device</source>
        <translation>Gerät</translation>
    </message>
    <message>
        <source>Discard 1 change</source>
        <translation>1 Änderung verwerfen</translation>
    </message>
    <message>
        <source>Discard {} changes</source>
        <translation>{} Änderungen verwerfen</translation>
    </message>
    <message>
        <source>Do and record all further steps</source>
        <translation>Alle weiteren Schritte tun und aufnehmen</translation>
    </message>
    <message>
        <source>Documents</source>
        <translation>Dokumente</translation>
    </message>
    <message>
        <source>Draw up to {} chosen tests in one plot</source>
        <translation>Bis zu {} gewählte Versuche in einem Bild zeichnen</translation>
    </message>
    <message>
        <source>Driver, identity and port</source>
        <translation>Treiber, Kennung und Anschluss</translation>
    </message>
    <message>
        <source>Duplicate</source>
        <translation>Duplizieren</translation>
    </message>
    <message>
        <source>Duplicate the test</source>
        <translation>Den Versuch duplizieren</translation>
    </message>
    <message>
        <source>Duration</source>
        <translation>Dauer</translation>
    </message>
    <message>
        <source>Duration in the other seconds</source>
        <translation>Dauer in den anderen Sekunden</translation>
    </message>
    <message>
        <source>Duration, empty: until ended</source>
        <translation>Dauer, leer: bis zum Beenden</translation>
    </message>
    <message>
        <source>Each roll is a test with all guards, and a file of its own. You can close the wizard: the roll under way goes on to its end, and the map can be taken up again.</source>
        <translation>Jeder Umlauf ist ein Versuch mit allen Wächtern und einer eigenen Datei. Der Assistent kann geschlossen werden: Der laufende Umlauf geht zu Ende, und die Karte kann später fortgesetzt werden.</translation>
    </message>
    <message>
        <source>Earlier</source>
        <translation>Früher</translation>
    </message>
    <message>
        <source>Ended</source>
        <translation>Ende</translation>
    </message>
    <message>
        <source>Engine</source>
        <translation>Steuerung</translation>
    </message>
    <message>
        <source>Every reading is saved at once. You can close the wizard at any time and take the calibration up again.</source>
        <translation>Jede Messung ist sofort gespeichert. Der Assistent kann jederzeit geschlossen und die Kalibrierung später fortgesetzt werden.</translation>
    </message>
    <message>
        <source>F on the follower, across the crank, counter-clockwise (the cell: the opposite)</source>
        <translation>F auf die Koppel, quer zur Kurbel, gegen den Uhrzeigersinn (Kraftsensor: umgekehrt)</translation>
    </message>
    <message>
        <source>F on the follower, away from the crank&apos;s centre (the cell feels the opposite)</source>
        <translation>F auf die Koppel, weg von der Kurbelmitte (der Kraftsensor spürt das Umgekehrte)</translation>
    </message>
    <message>
        <source>Factor</source>
        <translation>Faktor</translation>
    </message>
    <message>
        <source>Faults</source>
        <translation>Fehler</translation>
    </message>
    <message>
        <source>Felt / applied force</source>
        <translation>Gefühlte / aufgebrachte Kraft</translation>
    </message>
    <message>
        <source>File of the test</source>
        <translation>Datei des Versuchs</translation>
    </message>
    <message>
        <source>Find</source>
        <translation>Suchen</translation>
    </message>
    <message>
        <source>Find a fault</source>
        <translation>Einen Fehler suchen</translation>
    </message>
    <message>
        <source>Finish</source>
        <translation>Fertig</translation>
    </message>
    <message>
        <source>First samples</source>
        <translation>Erste Messwerte</translation>
    </message>
    <message>
        <source>First {:+.2f} degrees, now {:+.2f} degrees with the level turned: mean {:+.2f} +- {:.3f} degrees; the level itself is off by {:+.2f} degrees.</source>
        <translation>Zuerst {:+.2f} Grad, jetzt {:+.2f} Grad mit umgedrehter Wasserwaage: Mittel {:+.2f} +- {:.3f} Grad; die Wasserwaage selbst weicht um {:+.2f} Grad ab.</translation>
    </message>
    <message>
        <source>Force with its uncertainty</source>
        <translation>Kraft mit Unsicherheit</translation>
    </message>
    <message>
        <source>Fourier orders of the map</source>
        <translation>Fourier-Ordnungen der Karte</translation>
    </message>
    <message>
        <source>Frame of the force components</source>
        <translation>Bezugssystem der Kraftkomponenten</translation>
    </message>
    <message>
        <source>Fri</source>
        <translation>Fr</translation>
    </message>
    <message>
        <source>From the eighth check on the history has limits of its own</source>
        <translation>Ab der achten Prüfung hat der Verlauf eigene Grenzen</translation>
    </message>
    <message>
        <source>From the start</source>
        <translation>Von Anfang an</translation>
    </message>
    <message>
        <source>From − to + th&amp;is position</source>
        <translation>Von − bis + d&amp;iese Position</translation>
    </message>
    <message>
        <source>Full: 12 pin angles, 10 loads up and down</source>
        <translation>Voll: 12 Bolzenwinkel, 10 Lasten auf und ab</translation>
    </message>
    <message>
        <source>Full: 30 revolutions at each speed</source>
        <translation>Voll: 30 Umdrehungen bei jeder Drehzahl</translation>
    </message>
    <message>
        <source>Full: three times up and down</source>
        <translation>Voll: dreimal auf und ab</translation>
    </message>
    <message>
        <source>Gain of axis 1</source>
        <translation>Verstärkung der Achse 1</translation>
    </message>
    <message>
        <source>Gain of axis 2</source>
        <translation>Verstärkung der Achse 2</translation>
    </message>
    <message>
        <source>Go a&amp;head</source>
        <translation>Fort&amp;fahren</translation>
    </message>
    <message>
        <source>Go on</source>
        <translation>Weiter</translation>
    </message>
    <message>
        <source>Go on editing</source>
        <translation>Weiter bearbeiten</translation>
    </message>
    <message>
        <source>Go on viewing</source>
        <translation>Weiter zusehen</translation>
    </message>
    <message>
        <source>Go on with an interrupted or stopped test</source>
        <translation>Einen unterbrochenen oder angehaltenen Versuch fortsetzen</translation>
    </message>
    <message>
        <source>Go on with the paused test</source>
        <translation>Den angehaltenen Versuch fortsetzen</translation>
    </message>
    <message>
        <source>Go on with the test</source>
        <translation>Versuch fortsetzen</translation>
    </message>
    <message>
        <source>Go on with the test in its own file</source>
        <translation>Den Versuch in seiner eigenen Datei fortsetzen</translation>
    </message>
    <message>
        <source>Go on with the test in {}, or start another one.</source>
        <translation>Den Versuch in {} fortsetzen oder einen anderen starten.</translation>
    </message>
    <message>
        <source>Go to a revolution</source>
        <translation>Zu einer Umdrehung gehen</translation>
    </message>
    <message>
        <source>Health of the device</source>
        <translation>Zustand des Geräts</translation>
    </message>
    <message>
        <source>Help</source>
        <translation>Hilfe</translation>
    </message>
    <message>
        <source>Help F1</source>
        <translation>Hilfe F1</translation>
    </message>
    <message>
        <source>Hold the picture</source>
        <translation>Das Bild festhalten</translation>
    </message>
    <message>
        <source>How far it is</source>
        <translation>Wie weit es ist</translation>
    </message>
    <message>
        <source>How it ended</source>
        <translation>Wie er endete</translation>
    </message>
    <message>
        <source>How it stands</source>
        <translation>Wie es steht</translation>
    </message>
    <message>
        <source>How long step {} is</source>
        <translation>Wie lang Schritt {} ist</translation>
    </message>
    <message>
        <source>How many checks are good</source>
        <translation>Wie viele Prüfungen gut sind</translation>
    </message>
    <message>
        <source>How the test ended</source>
        <translation>Wie der Versuch endete</translation>
    </message>
    <message>
        <source>Hysteresis</source>
        <translation>Hysterese</translation>
    </message>
    <message>
        <source>Idle</source>
        <translation>Ruhe</translation>
    </message>
    <message>
        <source>If it comes again, check the encoder&apos;s cable, shield and supply.</source>
        <translation>Kommt es wieder: Kabel, Schirm und Versorgung des Drehgebers prüfen.</translation>
    </message>
    <message>
        <source>Input saturated</source>
        <translation>Eingang übersteuert</translation>
    </message>
    <message>
        <source>Internal failure</source>
        <translation>Interner Fehler</translation>
    </message>
    <message>
        <source>Interrupted</source>
        <translation>Unterbrochen</translation>
    </message>
    <message>
        <source>Is the follower on the pin, the bushing unworn, every hand away? Then begin.</source>
        <translation>Ist die Koppel auf dem Bolzen, die Buchse neu, keine Hand in der Nähe? Dann beginnen.</translation>
    </message>
    <message>
        <source>Is the test usable?</source>
        <translation>Ist der Versuch brauchbar?</translation>
    </message>
    <message>
        <source>Its own watchdog stops the motor.</source>
        <translation>Sein eigener Wächter hält den Motor an.</translation>
    </message>
    <message>
        <source>Jan</source>
        <translation>Jan</translation>
    </message>
    <message>
        <source>Joint</source>
        <translation>Gelenk</translation>
    </message>
    <message>
        <source>Joint force against crank angle</source>
        <translation>Gelenkkraft über dem Kurbelwinkel</translation>
    </message>
    <message>
        <source>Jul</source>
        <translation>Jul</translation>
    </message>
    <message>
        <source>Jun</source>
        <translation>Jun</translation>
    </message>
    <message>
        <source>Keep clear of the crank; check the drive&apos;s holding torque and the spring.</source>
        <translation>Abstand zur Kurbel halten; Haltemoment des Antriebs und Feder prüfen.</translation>
    </message>
    <message>
        <source>Keep this angle and turn the level end for end</source>
        <translation>Diesen Winkel behalten und die Wasserwaage umdrehen</translation>
    </message>
    <message>
        <source>Keys</source>
        <translation>Tasten</translation>
    </message>
    <message>
        <source>Largest force</source>
        <translation>Größte Kraft</translation>
    </message>
    <message>
        <source>Largest position</source>
        <translation>Größte Position</translation>
    </message>
    <message>
        <source>Last tests</source>
        <translation>Letzte Versuche</translation>
    </message>
    <message>
        <source>Lea&amp;ve the creep out</source>
        <translation>Das Kriechen aus&amp;lassen</translation>
    </message>
    <message>
        <source>Leave the file of a running test alone. Look where it is now before you copy it.</source>
        <translation>Die Datei eines laufenden Versuchs in Ruhe lassen. Vor dem Kopieren nachsehen, wo sie jetzt ist.</translation>
    </message>
    <message>
        <source>Leave the rig file as it is</source>
        <translation>Die Prüfstandsdatei lassen, wie sie ist</translation>
    </message>
    <message>
        <source>Let every window operate the rig again</source>
        <translation>Wieder jedes Fenster den Prüfstand bedienen lassen</translation>
    </message>
    <message>
        <source>Let the simulated hands do this step</source>
        <translation>Die simulierten Hände diesen Schritt tun lassen</translation>
    </message>
    <message>
        <source>Light F9</source>
        <translation>Hell F9</translation>
    </message>
    <message>
        <source>Light or dark</source>
        <translation>Hell oder dunkel</translation>
    </message>
    <message>
        <source>Limit</source>
        <translation>Grenze</translation>
    </message>
    <message>
        <source>Limited quantity</source>
        <translation>Begrenzte Größe</translation>
    </message>
    <message>
        <source>Limits</source>
        <translation>Grenzen</translation>
    </message>
    <message>
        <source>Limits of the running test</source>
        <translation>Grenzen des laufenden Versuchs</translation>
    </message>
    <message>
        <source>Limits of this test</source>
        <translation>Grenzen dieses Versuchs</translation>
    </message>
    <message>
        <source>Limits watched</source>
        <translation>Überwachte Grenzen</translation>
    </message>
    <message>
        <source>Lines of the log</source>
        <translation>Zeilen des Protokolls</translation>
    </message>
    <message>
        <source>Link</source>
        <translation>Verbindung</translation>
    </message>
    <message>
        <source>List of alarms</source>
        <translation>Liste der Alarme</translation>
    </message>
    <message>
        <source>List of checks</source>
        <translation>Liste der Prüfungen</translation>
    </message>
    <message>
        <source>List of studies</source>
        <translation>Liste der Studien</translation>
    </message>
    <message>
        <source>Load cell broken</source>
        <translation>Kraftsensor defekt</translation>
    </message>
    <message>
        <source>Load cell signal invalid</source>
        <translation>Signal des Kraftsensors ungültig</translation>
    </message>
    <message>
        <source>Load cell, probes, daily check.</source>
        <translation>Kraftsensor, Wegsensoren, tägliche Prüfung.</translation>
    </message>
    <message>
        <source>Local &amp;gravity</source>
        <translation>Ört&amp;liche Fallbeschleunigung</translation>
    </message>
    <message>
        <source>Log</source>
        <translation>Protokoll</translation>
    </message>
    <message>
        <source>Log of the test</source>
        <translation>Protokoll des Versuchs</translation>
    </message>
    <message>
        <source>Log of the test, newest first</source>
        <translation>Protokoll des Versuchs, Neuestes zuerst</translation>
    </message>
    <message>
        <source>Look at force, temperature and speed about that revolution, at lubrication and debris; note what was done.</source>
        <translation>Kraft, Temperatur und Drehzahl um diese Umdrehung ansehen, dazu Schmierung und Abrieb; notieren, was getan wurde.</translation>
    </message>
    <message>
        <source>Look at joint, spring and guide; check the zero; then reset and start again.</source>
        <translation>Gelenk, Feder und Führung ansehen; den Nullpunkt prüfen; dann zurücksetzen und neu starten.</translation>
    </message>
    <message>
        <source>Look at supply, temperature and load of the drive.</source>
        <translation>Versorgung, Temperatur und Last des Antriebs ansehen.</translation>
    </message>
    <message>
        <source>Look at the network and the server, and at rigapp notify --test; what waits is kept.</source>
        <translation>Netz und Server ansehen, und rigapp notify --test; was wartet, bleibt erhalten.</translation>
    </message>
    <message>
        <source>Look at the rig, then go on with the test (Results, or rigapp resume), or begin another.</source>
        <translation>Den Prüfstand ansehen, dann den Versuch fortsetzen (Ergebnisse, oder rigapp resume) oder einen anderen beginnen.</translation>
    </message>
    <message>
        <source>Look at the signal, its sensor, its range and its cable.</source>
        <translation>Das Signal, seinen Sensor, Bereich und Kabel ansehen.</translation>
    </message>
    <message>
        <source>Look at the trend and the joint; go on with the test in its file, or end it here.</source>
        <translation>Verlauf und Gelenk ansehen; den Versuch in seiner Datei fortsetzen oder hier beenden.</translation>
    </message>
    <message>
        <source>Look at the trend of this quantity; acknowledge, or change the limit with reason.</source>
        <translation>Den Verlauf dieser Größe ansehen; quittieren oder die Grenze mit Begründung ändern.</translation>
    </message>
    <message>
        <source>Look, compare, report.</source>
        <translation>Ansehen, vergleichen, berichten.</translation>
    </message>
    <message>
        <source>Looking for the engine of the rig. Results can be opened meanwhile.</source>
        <translation>Die Steuerung des Prüfstands wird gesucht. Ergebnisse lassen sich schon öffnen.</translation>
    </message>
    <message>
        <source>Lower speed or load, or note that this test ran beyond the range of its materials.</source>
        <translation>Drehzahl oder Last senken, oder notieren, dass dieser Versuch außerhalb des Bereichs seiner Werkstoffe lief.</translation>
    </message>
    <message>
        <source>Make room, or bring the folder back. Do not end the program before.</source>
        <translation>Platz schaffen oder den Ordner zurückbringen. Das Programm vorher nicht beenden.</translation>
    </message>
    <message>
        <source>Make the rig safe, release the button, then reset. Nothing restarts by itself.</source>
        <translation>Den Prüfstand sichern, den Taster lösen, dann zurücksetzen. Nichts läuft von selbst wieder an.</translation>
    </message>
    <message>
        <source>Manual</source>
        <translation>Handbuch</translation>
    </message>
    <message>
        <source>Mar</source>
        <translation>Mär</translation>
    </message>
    <message>
        <source>Mass (kg)</source>
        <translation>Masse (kg)</translation>
    </message>
    <message>
        <source>Mass of the hanger</source>
        <translation>Masse des Gehänges</translation>
    </message>
    <message>
        <source>Matrix and zero</source>
        <translation>Matrix und Nullpunkt</translation>
    </message>
    <message>
        <source>May</source>
        <translation>Mai</translation>
    </message>
    <message>
        <source>Measured minus model against crank angle</source>
        <translation>Messung minus Modell über dem Kurbelwinkel</translation>
    </message>
    <message>
        <source>Measured − model</source>
        <translation>Messung − Modell</translation>
    </message>
    <message>
        <source>Mechanism</source>
        <translation>Getriebe</translation>
    </message>
    <message>
        <source>Mechanism, joint and materials</source>
        <translation>Getriebe, Gelenk und Werkstoffe</translation>
    </message>
    <message>
        <source>Messages</source>
        <translation>Meldungen</translation>
    </message>
    <message>
        <source>Messages do not get through</source>
        <translation>Nachrichten kommen nicht durch</translation>
    </message>
    <message>
        <source>Micrometer &amp;shows</source>
        <translation>Messschraube &amp;zeigt</translation>
    </message>
    <message>
        <source>Minutes of shelving</source>
        <translation>Minuten des Zurückstellens</translation>
    </message>
    <message>
        <source>Mistake to practise</source>
        <translation>Fehler zum Üben</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>Modell</translation>
    </message>
    <message>
        <source>Model beside the data</source>
        <translation>Modell neben den Daten</translation>
    </message>
    <message>
        <source>Mon</source>
        <translation>Mo</translation>
    </message>
    <message>
        <source>N&amp;ame</source>
        <translation>N&amp;ame</translation>
    </message>
    <message>
        <source>N&amp;o, leave it</source>
        <translation>Nei&amp;n, so lassen</translation>
    </message>
    <message>
        <source>NOT STEADY</source>
        <translation>NICHT RUHIG</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Name of step {}</source>
        <translation>Name von Schritt {}</translation>
    </message>
    <message>
        <source>Name of the &amp;pin</source>
        <translation>Name des &amp;Bolzens</translation>
    </message>
    <message>
        <source>Name of the load cell</source>
        <translation>Name des Kraftsensors</translation>
    </message>
    <message>
        <source>Name of the probe</source>
        <translation>Name des Wegsensors</translation>
    </message>
    <message>
        <source>New</source>
        <translation>Neu</translation>
    </message>
    <message>
        <source>New spec&amp;imen…</source>
        <translation>Neue &amp;Probe…</translation>
    </message>
    <message>
        <source>New test</source>
        <translation>Neuer Versuch</translation>
    </message>
    <message>
        <source>New value</source>
        <translation>Neuer Wert</translation>
    </message>
    <message>
        <source>New value of the chosen limit</source>
        <translation>Neuer Wert der gewählten Grenze</translation>
    </message>
    <message>
        <source>Newest values</source>
        <translation>Neueste Werte</translation>
    </message>
    <message>
        <source>Newest values and limits</source>
        <translation>Neueste Werte und Grenzen</translation>
    </message>
    <message>
        <source>Next</source>
        <translation>Weiter</translation>
    </message>
    <message>
        <source>Next step</source>
        <translation>Nächster Schritt</translation>
    </message>
    <message>
        <source>No alarms</source>
        <translation>Keine Alarme</translation>
    </message>
    <message>
        <source>No alarms.</source>
        <translation>Keine Alarme.</translation>
    </message>
    <message>
        <source>No data</source>
        <translation>Keine Daten</translation>
    </message>
    <message>
        <source>No engine</source>
        <translation>Getrennt</translation>
    </message>
    <message>
        <source>No limit is watched now</source>
        <translation>Jetzt wird keine Grenze überwacht</translation>
    </message>
    <message>
        <source>No limits</source>
        <translation>Keine Grenzen</translation>
    </message>
    <message>
        <source>No other test of the queue begins.</source>
        <translation>Kein weiterer Versuch der Warteschlange beginnt.</translation>
    </message>
    <message>
        <source>No point has this result.</source>
        <translation>Kein Punkt hat dieses Ergebnis.</translation>
    </message>
    <message>
        <source>No results yet</source>
        <translation>Noch keine Ergebnisse</translation>
    </message>
    <message>
        <source>No steps</source>
        <translation>Keine Schritte</translation>
    </message>
    <message>
        <source>No study is in {}. `rigapp study STUDY.toml --to FOLDER` computes one; open its folder here.</source>
        <translation>In {} ist keine Studie. `rigapp study STUDIE.toml --to ORDNER` berechnet eine; hier ihren Ordner öffnen.</translation>
    </message>
    <message>
        <source>No test is armed. Choose a test file, or save the new one in Prepare.</source>
        <translation>Kein Versuch ist scharf. Eine Versuchsdatei wählen oder den neuen unter Vorbereiten speichern.</translation>
    </message>
    <message>
        <source>No test is in the queue. Add test files: each is recorded into a file of its own, and the next one begins when one is complete.</source>
        <translation>Kein Versuch ist in der Warteschlange. Versuchsdateien hinzufügen: jeder wird in eine eigene Datei aufgezeichnet, und der nächste beginnt, wenn einer vollständig ist.</translation>
    </message>
    <message>
        <source>No test yet</source>
        <translation>Noch kein Versuch</translation>
    </message>
    <message>
        <source>Nobody is in command</source>
        <translation>Niemand hat das Kommando</translation>
    </message>
    <message>
        <source>None</source>
        <translation>Keine</translation>
    </message>
    <message>
        <source>None yet: a limit tells when the joint changes.</source>
        <translation>Noch keine: Eine Grenze sagt, wann sich das Gelenk ändert.</translation>
    </message>
    <message>
        <source>None: the test runs at one speed from its first revolution to its last.</source>
        <translation>Keine: der Versuch läuft von der ersten bis zur letzten Umdrehung mit einer Drehzahl.</translation>
    </message>
    <message>
        <source>Not closed</source>
        <translation>Nicht abgeschlossen</translation>
    </message>
    <message>
        <source>Not saved before {}: {}</source>
        <translation>Nicht gespeichert vor: {}: {}</translation>
    </message>
    <message>
        <source>Not saved: {}{}.</source>
        <translation>Nicht gespeichert: {}{}.</translation>
    </message>
    <message>
        <source>Not usable yet. {}{}</source>
        <translation>Noch nicht brauchbar. {}{}</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>Notiz</translation>
    </message>
    <message>
        <source>Note or reason (F8)</source>
        <translation>Notiz oder Grund (F8)</translation>
    </message>
    <message>
        <source>Note: </source>
        <translation>Hinweis: </translation>
    </message>
    <message>
        <source>Nothing is lost; the test goes on and is recorded.</source>
        <translation>Nichts ist verloren; der Versuch geht weiter und wird aufgezeichnet.</translation>
    </message>
    <message>
        <source>Nothing lost</source>
        <translation>Nichts verloren</translation>
    </message>
    <message>
        <source>Nothing turns by itself; what the file holds is safe.</source>
        <translation>Nichts dreht sich von selbst; was in der Datei steht, ist sicher.</translation>
    </message>
    <message>
        <source>Nothing was done.</source>
        <translation>Es wurde nichts getan.</translation>
    </message>
    <message>
        <source>Nov</source>
        <translation>Nov</translation>
    </message>
    <message>
        <source>Now</source>
        <translation>Jetzt</translation>
    </message>
    <message>
        <source>Number</source>
        <translation>Nummer</translation>
    </message>
    <message>
        <source>Number of the reading</source>
        <translation>Nummer der Messung</translation>
    </message>
    <message>
        <source>Number of the result</source>
        <translation>Zahl des Ergebnisses</translation>
    </message>
    <message>
        <source>Numbers and uncertainty</source>
        <translation>Zahlen und Unsicherheit</translation>
    </message>
    <message>
        <source>Oct</source>
        <translation>Okt</translation>
    </message>
    <message>
        <source>Of</source>
        <translation>Von</translation>
    </message>
    <message>
        <source>One revolution</source>
        <translation>Eine Umdrehung</translation>
    </message>
    <message>
        <source>Op&amp;en…</source>
        <translation>Ö&amp;ffnen…</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Öffnen</translation>
    </message>
    <message>
        <source>Open a test</source>
        <translation>Einen Versuch öffnen</translation>
    </message>
    <message>
        <source>Open a test file</source>
        <translation>Eine Versuchsdatei öffnen</translation>
    </message>
    <message>
        <source>Open another stud&amp;y…</source>
        <translation>Andere Studie öff&amp;nen…</translation>
    </message>
    <message>
        <source>Open another study</source>
        <translation>Andere Studie öffnen</translation>
    </message>
    <message>
        <source>Open results</source>
        <translation>Ergebnisse öffnen</translation>
    </message>
    <message>
        <source>Open {}</source>
        <translation>{} öffnen</translation>
    </message>
    <message>
        <source>Or&amp;ders of the map</source>
        <translation>&amp;Ordnungen der Karte</translation>
    </message>
    <message>
        <source>Overload</source>
        <translation>Überlast</translation>
    </message>
    <message>
        <source>Overspeed</source>
        <translation>Überdrehzahl</translation>
    </message>
    <message>
        <source>Overview</source>
        <translation>Überblick</translation>
    </message>
    <message>
        <source>P&amp;lan</source>
        <translation>P&amp;lan</translation>
    </message>
    <message>
        <source>Pages</source>
        <translation>Seiten</translation>
    </message>
    <message>
        <source>Pairing beyond its range</source>
        <translation>Paarung außerhalb ihres Bereichs</translation>
    </message>
    <message>
        <source>Panels</source>
        <translation>Felder</translation>
    </message>
    <message>
        <source>Parameter</source>
        <translation>Parameter</translation>
    </message>
    <message>
        <source>Parameter to draw it against</source>
        <translation>Parameter, gegen den gezeichnet wird</translation>
    </message>
    <message>
        <source>Pause  F6</source>
        <translation>Pause  F6</translation>
    </message>
    <message>
        <source>Pause not reached</source>
        <translation>Pause nicht erreicht</translation>
    </message>
    <message>
        <source>Paused</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>Pausing</source>
        <translation>Anhalten</translation>
    </message>
    <message>
        <source>Pin</source>
        <translation>Bolzen</translation>
    </message>
    <message>
        <source>Pl&amp;ace</source>
        <translation>St&amp;elle</translation>
    </message>
    <message>
        <source>Place in the recorded test</source>
        <translation>Stelle im aufgezeichneten Versuch</translation>
    </message>
    <message>
        <source>Places</source>
        <translation>Orte</translation>
    </message>
    <message>
        <source>Plan and weights</source>
        <translation>Plan und Gewichte</translation>
    </message>
    <message>
        <source>Plan fewer whole cycles, or a new test.</source>
        <translation>Weniger ganze Zyklen oder einen neuen Versuch planen.</translation>
    </message>
    <message>
        <source>Play  F7</source>
        <translation>Abspielen  F7</translation>
    </message>
    <message>
        <source>Play or pause</source>
        <translation>Abspielen oder anhalten</translation>
    </message>
    <message>
        <source>Point</source>
        <translation>Punkt</translation>
    </message>
    <message>
        <source>Points</source>
        <translation>Punkte</translation>
    </message>
    <message>
        <source>Points of the study</source>
        <translation>Punkte der Studie</translation>
    </message>
    <message>
        <source>Points without a result</source>
        <translation>Punkte ohne Ergebnis</translation>
    </message>
    <message>
        <source>Posi&amp;tions of a run</source>
        <translation>Posi&amp;tionen eines Durchgangs</translation>
    </message>
    <message>
        <source>Position (µm)</source>
        <translation>Position (µm)</translation>
    </message>
    <message>
        <source>Position that the micrometer shows</source>
        <translation>Position, die die Messschraube zeigt</translation>
    </message>
    <message>
        <source>Prepare</source>
        <translation>Vorbereiten</translation>
    </message>
    <message>
        <source>Prepare a test</source>
        <translation>Einen Versuch vorbereiten</translation>
    </message>
    <message>
        <source>Prepare the test of the next specimen</source>
        <translation>Den Versuch der nächsten Probe vorbereiten</translation>
    </message>
    <message>
        <source>Press the emergency stop. Do not touch the rig before the crank stands.</source>
        <translation>Not-Halt drücken. Den Prüfstand nicht berühren, bevor die Kurbel steht.</translation>
    </message>
    <message>
        <source>Probe 1 (V)</source>
        <translation>Wegsensor 1 (V)</translation>
    </message>
    <message>
        <source>Probe 1, along the follower</source>
        <translation>Wegsensor 1, längs der Koppel</translation>
    </message>
    <message>
        <source>Probe 2 (V)</source>
        <translation>Wegsensor 2 (V)</translation>
    </message>
    <message>
        <source>Probe 2, across the follower</source>
        <translation>Wegsensor 2, quer zur Koppel</translation>
    </message>
    <message>
        <source>Probe and plan</source>
        <translation>Wegsensor und Plan</translation>
    </message>
    <message>
        <source>Problems</source>
        <translation>Probleme</translation>
    </message>
    <message>
        <source>Progress and time left</source>
        <translation>Fortschritt und restliche Zeit</translation>
    </message>
    <message>
        <source>Progress of the calibration</source>
        <translation>Fortschritt der Kalibrierung</translation>
    </message>
    <message>
        <source>Progress of the rolls</source>
        <translation>Fortschritt der Umläufe</translation>
    </message>
    <message>
        <source>Progress of the test</source>
        <translation>Fortschritt des Versuchs</translation>
    </message>
    <message>
        <source>Put it right; rigapp queue start goes on with this test, rigapp queue remove leaves it out.</source>
        <translation>In Ordnung bringen; rigapp queue start setzt diesen Versuch fort, rigapp queue remove lässt ihn aus.</translation>
    </message>
    <message>
        <source>Put step {} earlier</source>
        <translation>Schritt {} früher setzen</translation>
    </message>
    <message>
        <source>Put the notice away</source>
        <translation>Die Meldung wegräumen</translation>
    </message>
    <message>
        <source>Quality of the link</source>
        <translation>Güte der Verbindung</translation>
    </message>
    <message>
        <source>Quantity</source>
        <translation>Größe</translation>
    </message>
    <message>
        <source>Quantity of the trend</source>
        <translation>Größe des Verlaufs</translation>
    </message>
    <message>
        <source>Quantity to compare</source>
        <translation>Größe des Vergleichs</translation>
    </message>
    <message>
        <source>Queue</source>
        <translation>Warteschlange</translation>
    </message>
    <message>
        <source>REPLAY</source>
        <translation>WIEDERGABE</translation>
    </message>
    <message>
        <source>RMS</source>
        <translation>RMS</translation>
    </message>
    <message>
        <source>RMS of |F| of the joint</source>
        <translation>Effektivwert von |F| des Gelenks</translation>
    </message>
    <message>
        <source>RMS to the model; worst cycle {:.1f} N</source>
        <translation>RMS zum Modell; schlechtester Zyklus {:.1f} N</translation>
    </message>
    <message>
        <source>RMS, this cycle</source>
        <translation>RMS, dieser Zyklus</translation>
    </message>
    <message>
        <source>RMS, {} cycles ago</source>
        <translation>RMS, vor {} Zyklen</translation>
    </message>
    <message>
        <source>Range of the result</source>
        <translation>Bereich des Ergebnisses</translation>
    </message>
    <message>
        <source>Range or error of {}</source>
        <translation>Bereich oder Fehler von {}</translation>
    </message>
    <message>
        <source>Re&amp;ason</source>
        <translation>&amp;Grund</translation>
    </message>
    <message>
        <source>Re&amp;ject and repeat its series</source>
        <translation>&amp;Verwerfen und die Reihe wiederholen</translation>
    </message>
    <message>
        <source>Re&amp;move</source>
        <translation>&amp;Entfernen</translation>
    </message>
    <message>
        <source>Re&amp;volution</source>
        <translation>&amp;Umdrehung</translation>
    </message>
    <message>
        <source>Re&amp;volutions</source>
        <translation>&amp;Umdrehungen</translation>
    </message>
    <message>
        <source>Rea&amp;son</source>
        <translation>&amp;Grund</translation>
    </message>
    <message>
        <source>Read it again</source>
        <translation>Neu lesen</translation>
    </message>
    <message>
        <source>Read the folder again</source>
        <translation>Den Ordner neu lesen</translation>
    </message>
    <message>
        <source>Read the folders again</source>
        <translation>Die Ordner noch einmal lesen</translation>
    </message>
    <message>
        <source>Reading</source>
        <translation>Messung</translation>
    </message>
    <message>
        <source>Reading what the test came to …</source>
        <translation>Das Ergebnis wird gelesen …</translation>
    </message>
    <message>
        <source>Readings</source>
        <translation>Messungen</translation>
    </message>
    <message>
        <source>Ready</source>
        <translation>Bereit</translation>
    </message>
    <message>
        <source>Ready: the devices are connected. Start a test with F5.</source>
        <translation>Bereit: Die Geräte sind verbunden. F5 startet einen Versuch.</translation>
    </message>
    <message>
        <source>Real or simulated seconds</source>
        <translation>Echte oder simulierte Sekunden</translation>
    </message>
    <message>
        <source>Reason for shelving</source>
        <translation>Grund des Zurückstellens</translation>
    </message>
    <message>
        <source>Reason for the new limit</source>
        <translation>Grund der neuen Grenze</translation>
    </message>
    <message>
        <source>Reason for zeroing</source>
        <translation>Grund des Nullens</translation>
    </message>
    <message>
        <source>Reason of the rejection</source>
        <translation>Grund des Verwerfens</translation>
    </message>
    <message>
        <source>Reason or note</source>
        <translation>Grund oder Notiz</translation>
    </message>
    <message>
        <source>Reconnect</source>
        <translation>Neu verbinden</translation>
    </message>
    <message>
        <source>Record</source>
        <translation>Aufzeichnung</translation>
    </message>
    <message>
        <source>Record to make</source>
        <translation>Anzulegender Kalibrierdatensatz</translation>
    </message>
    <message>
        <source>Recorded tests</source>
        <translation>Aufgezeichnete Versuche</translation>
    </message>
    <message>
        <source>Recorded tests, newest first</source>
        <translation>Aufgezeichnete Versuche, neueste zuerst</translation>
    </message>
    <message>
        <source>Recover</source>
        <translation>Zurück zum Versuch</translation>
    </message>
    <message>
        <source>Refused</source>
        <translation>Abgelehnt</translation>
    </message>
    <message>
        <source>Reject the selected reading and repeat its series</source>
        <translation>Die gewählte Messung verwerfen und ihre Reihe wiederholen</translation>
    </message>
    <message>
        <source>Reject the selected reading, repeat its series</source>
        <translation>Die gewählte Messung verwerfen, ihre Reihe wiederholen</translation>
    </message>
    <message>
        <source>Release command</source>
        <translation>Kommando abgeben</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Remove step {}</source>
        <translation>Schritt {} entfernen</translation>
    </message>
    <message>
        <source>Remove the cause</source>
        <translation>Ursache beheben</translation>
    </message>
    <message>
        <source>Remove the cause as the drive&apos;s manual says, then reset.</source>
        <translation>Die Ursache nach dem Handbuch des Antriebs beheben, dann zurücksetzen.</translation>
    </message>
    <message>
        <source>Remove the cause, then connect the devices.</source>
        <translation>Die Ursache beheben, dann die Geräte verbinden.</translation>
    </message>
    <message>
        <source>Repeat from step</source>
        <translation>Wiederholen ab Schritt</translation>
    </message>
    <message>
        <source>Replay</source>
        <translation>Wiedergabe</translation>
    </message>
    <message>
        <source>Replay from the start</source>
        <translation>Wiedergabe von Anfang an</translation>
    </message>
    <message>
        <source>Reset</source>
        <translation>Zurücksetzen</translation>
    </message>
    <message>
        <source>Reset after a trip</source>
        <translation>Zurücksetzen nach einer Abschaltung</translation>
    </message>
    <message>
        <source>Reset after trip</source>
        <translation>Zurücksetzen nach Abschaltung</translation>
    </message>
    <message>
        <source>Reset: the deliberate step before another start. Nothing moves.</source>
        <translation>Zurücksetzen: der bewusste Schritt vor einem neuen Start. Nichts bewegt sich.</translation>
    </message>
    <message>
        <source>Residual</source>
        <translation>Abweichung</translation>
    </message>
    <message>
        <source>Residuals in words</source>
        <translation>Abweichungen in Worten</translation>
    </message>
    <message>
        <source>Residuals of the readings so far, N</source>
        <translation>Abweichungen der bisherigen Messungen, N</translation>
    </message>
    <message>
        <source>Residuals so far, micrometres</source>
        <translation>Bisherige Abweichungen, Mikrometer</translation>
    </message>
    <message>
        <source>Rest</source>
        <translation>Ruhe</translation>
    </message>
    <message>
        <source>Rest after step {}</source>
        <translation>Ruhe nach Schritt {}</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>Ergebnis</translation>
    </message>
    <message>
        <source>Result against parameter</source>
        <translation>Ergebnis gegen Parameter</translation>
    </message>
    <message>
        <source>Result of the test</source>
        <translation>Ergebnis des Versuchs</translation>
    </message>
    <message>
        <source>Result to draw</source>
        <translation>Ergebnis, das gezeichnet wird</translation>
    </message>
    <message>
        <source>Results</source>
        <translation>Ergebnisse</translation>
    </message>
    <message>
        <source>Resume the paused test.</source>
        <translation>Den angehaltenen Versuch fortsetzen.</translation>
    </message>
    <message>
        <source>Resume the test</source>
        <translation>Versuch fortsetzen</translation>
    </message>
    <message>
        <source>Revolutions cannot be cut at the index, so the test was stopped.</source>
        <translation>Umdrehungen können nicht am Index getrennt werden; der Versuch wurde gestoppt.</translation>
    </message>
    <message>
        <source>Revolutions, 0: as in the test</source>
        <translation>Umdrehungen, 0: wie im Versuch</translation>
    </message>
    <message>
        <source>Rig</source>
        <translation>Prüfstand</translation>
    </message>
    <message>
        <source>Rig control</source>
        <translation>Bedienung des Prüfstands</translation>
    </message>
    <message>
        <source>Rig, speed and file of the test</source>
        <translation>Prüfstand, Drehzahl und Datei des Versuchs</translation>
    </message>
    <message>
        <source>Rolls</source>
        <translation>Umläufe</translation>
    </message>
    <message>
        <source>Routine: 12 revolutions at each speed</source>
        <translation>Routine: 12 Umdrehungen bei jeder Drehzahl</translation>
    </message>
    <message>
        <source>Routine: 4 pin angles, 5 loads up and down</source>
        <translation>Routine: 4 Bolzenwinkel, 5 Lasten auf und ab</translation>
    </message>
    <message>
        <source>Routine: once up and down</source>
        <translation>Routine: einmal auf und ab</translation>
    </message>
    <message>
        <source>Rule</source>
        <translation>Regel</translation>
    </message>
    <message>
        <source>Run</source>
        <translation>Lauf</translation>
    </message>
    <message>
        <source>Run-out</source>
        <translation>Rundlauf</translation>
    </message>
    <message>
        <source>Run-out map, micrometres</source>
        <translation>Rundlaufkarte, Mikrometer</translation>
    </message>
    <message>
        <source>Running</source>
        <translation>Läuft</translation>
    </message>
    <message>
        <source>Running as planned.</source>
        <translation>Läuft wie geplant.</translation>
    </message>
    <message>
        <source>S&amp;helve</source>
        <translation>&amp;Zurückstellen</translation>
    </message>
    <message>
        <source>S&amp;top</source>
        <translation>S&amp;topp</translation>
    </message>
    <message>
        <source>SIMULATED</source>
        <translation>SIMULIERT</translation>
    </message>
    <message>
        <source>STEADY</source>
        <translation>RUHIG</translation>
    </message>
    <message>
        <source>Samples lost</source>
        <translation>Messwerte verloren</translation>
    </message>
    <message>
        <source>Samples may have been lost unseen; the revolution is flagged.</source>
        <translation>Messwerte können unbemerkt verloren sein; die Umdrehung ist gekennzeichnet.</translation>
    </message>
    <message>
        <source>Sat</source>
        <translation>Sa</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>Speichern</translation>
    </message>
    <message>
        <source>Save  Ctrl+S</source>
        <translation>Speichern  Strg+S</translation>
    </message>
    <message>
        <source>Save as another test file</source>
        <translation>Als andere Versuchsdatei speichern</translation>
    </message>
    <message>
        <source>Save as…</source>
        <translation>Speichern als…</translation>
    </message>
    <message>
        <source>Save the &amp;record as</source>
        <translation>Kalibrierdatensatz speichern &amp;als</translation>
    </message>
    <message>
        <source>Save the changes</source>
        <translation>Änderungen speichern</translation>
    </message>
    <message>
        <source>Save the log and report it; reconnect before the next test.</source>
        <translation>Das Protokoll sichern und melden; vor dem nächsten Versuch neu verbinden.</translation>
    </message>
    <message>
        <source>Save the test as</source>
        <translation>Den Versuch speichern als</translation>
    </message>
    <message>
        <source>Save the test file</source>
        <translation>Die Versuchsdatei speichern</translation>
    </message>
    <message>
        <source>Schema</source>
        <translation>Schema</translation>
    </message>
    <message>
        <source>Sensitivity of the daily checks</source>
        <translation>Empfindlichkeit der täglichen Prüfungen</translation>
    </message>
    <message>
        <source>Sensor broken</source>
        <translation>Sensor defekt</translation>
    </message>
    <message>
        <source>Sensor broken before</source>
        <translation>Sensor vorher defekt</translation>
    </message>
    <message>
        <source>Sep</source>
        <translation>Sep</translation>
    </message>
    <message>
        <source>Sequence</source>
        <translation>Abfolge</translation>
    </message>
    <message>
        <source>Series</source>
        <translation>Reihe</translation>
    </message>
    <message>
        <source>Set it right in the rig file, connect again, and compare both speeds on the Devices tab.</source>
        <translation>In der Prüfstandsdatei berichtigen, neu verbinden und beide Drehzahlen auf der Seite Geräte vergleichen.</translation>
    </message>
    <message>
        <source>Set it right, connect again, and watch the first turn.</source>
        <translation>Berichtigen, neu verbinden und die erste Umdrehung beobachten.</translation>
    </message>
    <message>
        <source>Set speed lost</source>
        <translation>Solldrehzahl verloren</translation>
    </message>
    <message>
        <source>Set speed not reached</source>
        <translation>Solldrehzahl nicht erreicht</translation>
    </message>
    <message>
        <source>Settings (*.toml)</source>
        <translation>Einstellungen (*.toml)</translation>
    </message>
    <message>
        <source>Settings file of the calibration</source>
        <translation>Einstellungsdatei der Kalibrierung</translation>
    </message>
    <message>
        <source>Severity</source>
        <translation>Schwere</translation>
    </message>
    <message>
        <source>Shape of the state</source>
        <translation>Form des Zustands</translation>
    </message>
    <message>
        <source>Shelve the chosen alarm</source>
        <translation>Den gewählten Alarm zurückstellen</translation>
    </message>
    <message>
        <source>Show mechanism and materials</source>
        <translation>Getriebe und Werkstoffe zeigen</translation>
    </message>
    <message>
        <source>Show only lines with this text</source>
        <translation>Nur Zeilen mit diesem Text zeigen</translation>
    </message>
    <message>
        <source>Show only tests that ended so</source>
        <translation>Nur Versuche mit diesem Ende zeigen</translation>
    </message>
    <message>
        <source>Show only tests with these words</source>
        <translation>Nur Versuche mit diesen Wörtern zeigen</translation>
    </message>
    <message>
        <source>Signal</source>
        <translation>Signal</translation>
    </message>
    <message>
        <source>Signal 1</source>
        <translation>Signal 1</translation>
    </message>
    <message>
        <source>Signal 2</source>
        <translation>Signal 2</translation>
    </message>
    <message>
        <source>Signals now</source>
        <translation>Signale jetzt</translation>
    </message>
    <message>
        <source>Silent</source>
        <translation>Stumm</translation>
    </message>
    <message>
        <source>Simulated</source>
        <translation>Simuliert</translation>
    </message>
    <message>
        <source>Simulated faults</source>
        <translation>Simulierte Fehler</translation>
    </message>
    <message>
        <source>Simulated hands</source>
        <translation>Simulierte Hände</translation>
    </message>
    <message>
        <source>Simulated or replayed</source>
        <translation>Simuliert oder wiedergegeben</translation>
    </message>
    <message>
        <source>Since when</source>
        <translation>Seit wann</translation>
    </message>
    <message>
        <source>Slow rolls</source>
        <translation>Langsame Umläufe</translation>
    </message>
    <message>
        <source>Sp&amp;eeds (rpm)</source>
        <translation>&amp;Drehzahlen (rpm)</translation>
    </message>
    <message>
        <source>Specimen</source>
        <translation>Probe</translation>
    </message>
    <message>
        <source>Specimen, cycles and times</source>
        <translation>Probe, Zyklen und Zeiten</translation>
    </message>
    <message>
        <source>Spee&amp;d</source>
        <translation>&amp;Tempo</translation>
    </message>
    <message>
        <source>Speed</source>
        <translation>Drehzahl</translation>
    </message>
    <message>
        <source>Speed of step {}</source>
        <translation>Drehzahl von Schritt {}</translation>
    </message>
    <message>
        <source>Speed of the replay</source>
        <translation>Tempo der Wiedergabe</translation>
    </message>
    <message>
        <source>Speed, revolutions or every angle would be wrong by their ratio, so the test was stopped.</source>
        <translation>Drehzahl, Umdrehungen oder jeder Winkel wären um ihr Verhältnis falsch; der Versuch wurde gestoppt.</translation>
    </message>
    <message>
        <source>Speeds differ</source>
        <translation>Drehzahlen verschieden</translation>
    </message>
    <message>
        <source>Speeds of the rolls, revolutions per minute</source>
        <translation>Drehzahlen der Umläufe in Umdrehungen pro Minute</translation>
    </message>
    <message>
        <source>Spindle not shown to stand</source>
        <translation>Stillstand der Spindel nicht gezeigt</translation>
    </message>
    <message>
        <source>Spring</source>
        <translation>Feder</translation>
    </message>
    <message>
        <source>Stability of the signal</source>
        <translation>Ruhe des Signals</translation>
    </message>
    <message>
        <source>Standard &amp;uncertainty of the level</source>
        <translation>Standard&amp;unsicherheit der Wasserwaage</translation>
    </message>
    <message>
        <source>Standard uncertainty of the level</source>
        <translation>Standardunsicherheit der Wasserwaage</translation>
    </message>
    <message>
        <source>Standard uncertainty of the micrometer</source>
        <translation>Standardunsicherheit der Messschraube</translation>
    </message>
    <message>
        <source>Start</source>
        <translation>Start</translation>
    </message>
    <message>
        <source>Start a test</source>
        <translation>Einen Versuch starten</translation>
    </message>
    <message>
        <source>Start a test.</source>
        <translation>Einen Versuch starten.</translation>
    </message>
    <message>
        <source>Start a test…</source>
        <translation>Versuch starten…</translation>
    </message>
    <message>
        <source>Start another test…</source>
        <translation>Anderen Versuch starten…</translation>
    </message>
    <message>
        <source>Start no&amp;w</source>
        <translation>&amp;Jetzt starten</translation>
    </message>
    <message>
        <source>Starting</source>
        <translation>Anlauf</translation>
    </message>
    <message>
        <source>Starting: the zeros are taken, then the spindle is brought to speed.</source>
        <translation>Anlauf: Die Nullpunkte werden genommen, dann wird die Spindel auf Drehzahl gebracht.</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>State of the alarm</source>
        <translation>Zustand des Alarms</translation>
    </message>
    <message>
        <source>State of the comparison</source>
        <translation>Stand des Vergleichs</translation>
    </message>
    <message>
        <source>State of the test</source>
        <translation>Zustand des Versuchs</translation>
    </message>
    <message>
        <source>Statistics of the revolution shown, in N</source>
        <translation>Kennwerte der gezeigten Umdrehung in N</translation>
    </message>
    <message>
        <source>Stay</source>
        <translation>Bleiben</translation>
    </message>
    <message>
        <source>Stay in the window</source>
        <translation>Im Fenster bleiben</translation>
    </message>
    <message>
        <source>Step</source>
        <translation>Schritt</translation>
    </message>
    <message>
        <source>Step after</source>
        <translation>Schritt danach</translation>
    </message>
    <message>
        <source>Step before</source>
        <translation>Schritt davor</translation>
    </message>
    <message>
        <source>Step {}, {}: {}</source>
        <translation>Schritt {}, {}: {}</translation>
    </message>
    <message>
        <source>Step: {}</source>
        <translation>Schritt: {}</translation>
    </message>
    <message>
        <source>Steps</source>
        <translation>Schritte</translation>
    </message>
    <message>
        <source>Steps of preparing a test</source>
        <translation>Schritte zur Vorbereitung eines Versuchs</translation>
    </message>
    <message>
        <source>Steps of this test</source>
        <translation>Schritte dieses Versuchs</translation>
    </message>
    <message>
        <source>Steps of {:g} µm; {}</source>
        <translation>Schritte von {:g} µm; {}</translation>
    </message>
    <message>
        <source>Steps that are done</source>
        <translation>Erledigte Schritte</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Stopp</translation>
    </message>
    <message>
        <source>Stop &amp;after this test</source>
        <translation>Nach diesem Versuch &amp;anhalten</translation>
    </message>
    <message>
        <source>Stop at the safe angle; the test can be resumed</source>
        <translation>Am sicheren Winkel anhalten; der Versuch kann fortgesetzt werden</translation>
    </message>
    <message>
        <source>Stop other programs that write to this disk; look at its health and its network.</source>
        <translation>Andere Programme beenden, die auf diese Festplatte schreiben; ihren Zustand und ihr Netz ansehen.</translation>
    </message>
    <message>
        <source>Stop test, then close</source>
        <translation>Stoppen, dann schließen</translation>
    </message>
    <message>
        <source>Stop the test where it was started (Ctrl-C), or by the emergency stop.</source>
        <translation>Den Versuch dort stoppen, wo er gestartet wurde (Strg-C), oder mit dem Not-Halt.</translation>
    </message>
    <message>
        <source>Stop the test, then close the window</source>
        <translation>Den Versuch stoppen, dann das Fenster schließen</translation>
    </message>
    <message>
        <source>Stopped</source>
        <translation>Gestoppt</translation>
    </message>
    <message>
        <source>Stopped by the operator</source>
        <translation>Vom Bediener angehalten</translation>
    </message>
    <message>
        <source>Stopping</source>
        <translation>Auslauf</translation>
    </message>
    <message>
        <source>Stopping the test; the window closes when the spindle stands.</source>
        <translation>Der Versuch wird gestoppt; das Fenster schließt, wenn die Spindel steht.</translation>
    </message>
    <message>
        <source>Stored revol&amp;ution</source>
        <translation>Gespeicherte &amp;Umdrehung</translation>
    </message>
    <message>
        <source>Stored revolution to compare with</source>
        <translation>Gespeicherte Umdrehung zum Vergleich</translation>
    </message>
    <message>
        <source>Studies</source>
        <translation>Studien</translation>
    </message>
    <message>
        <source>Studies in the folder</source>
        <translation>Studien im Ordner</translation>
    </message>
    <message>
        <source>Study</source>
        <translation>Studie</translation>
    </message>
    <message>
        <source>Sun</source>
        <translation>So</translation>
    </message>
    <message>
        <source>Switch the drive off when any |F| sample is above</source>
        <translation>Antrieb aus, wenn irgendein Wert von |F| größer ist als</translation>
    </message>
    <message>
        <source>Switch the drive off when the newest data are older than</source>
        <translation>Antrieb aus, wenn die neuesten Daten älter sind als</translation>
    </message>
    <message>
        <source>Switch the drive off when the speed is above</source>
        <translation>Antrieb aus, wenn die Drehzahl größer ist als</translation>
    </message>
    <message>
        <source>T&amp;urn the micrometer</source>
        <translation>&amp;Messschraube drehen</translation>
    </message>
    <message>
        <source>THE SPINDLE MAY STILL TURN.</source>
        <translation>DIE SPINDEL DREHT SICH VIELLEICHT NOCH.</translation>
    </message>
    <message>
        <source>Table, CSV</source>
        <translation>Tabelle, CSV</translation>
    </message>
    <message>
        <source>Table, Parquet</source>
        <translation>Tabelle, Parquet</translation>
    </message>
    <message>
        <source>Take command</source>
        <translation>Kommando nehmen</translation>
    </message>
    <message>
        <source>Take command from {name}</source>
        <translation>{name} das Kommando nehmen</translation>
    </message>
    <message>
        <source>Take command from {name}? {name} can then only look; the log records it.</source>
        <translation>{name} das Kommando nehmen? {name} kann dann nur noch zusehen; das Protokoll hält es fest.</translation>
    </message>
    <message>
        <source>Take over command</source>
        <translation>Das Kommando übernehmen</translation>
    </message>
    <message>
        <source>Take over…</source>
        <translation>Übernehmen…</translation>
    </message>
    <message>
        <source>Take the chosen test out of the queue; what it has recorded stays</source>
        <translation>Den gewählten Versuch aus der Warteschlange nehmen; was er aufgezeichnet hat, bleibt</translation>
    </message>
    <message>
        <source>Take the present signals as zero force: the crank stands, the pin carries nothing. Old and new zero are logged; the calibration is not touched.</source>
        <translation>Die jetzigen Signale als Kraft null nehmen: Die Kurbel steht, der Bolzen trägt nichts. Alter und neuer Nullpunkt kommen ins Protokoll; die Kalibrierung bleibt unberührt.</translation>
    </message>
    <message>
        <source>Take up {}</source>
        <translation>{} fortsetzen</translation>
    </message>
    <message>
        <source>Test</source>
        <translation>Versuch</translation>
    </message>
    <message>
        <source>Test &amp;file</source>
        <translation>Versuchs&amp;datei</translation>
    </message>
    <message>
        <source>Test complete after so many revolutions</source>
        <translation>Versuch vollständig nach so vielen Umdrehungen</translation>
    </message>
    <message>
        <source>Test file</source>
        <translation>Versuchsdatei</translation>
    </message>
    <message>
        <source>Test file of this mechanism</source>
        <translation>Versuchsdatei dieses Getriebes</translation>
    </message>
    <message>
        <source>Test file that is edited</source>
        <translation>Versuchsdatei, die bearbeitet wird</translation>
    </message>
    <message>
        <source>Test {} did not end as planned, and the queue stopped there. Start the queue to go on with it in its own file, or remove it.</source>
        <translation>Versuch {} endete nicht wie geplant, und die Warteschlange blieb dort stehen. Die Warteschlange beginnen, um ihn in seiner Datei fortzusetzen, oder ihn entfernen.</translation>
    </message>
    <message>
        <source>Tests</source>
        <translation>Versuche</translation>
    </message>
    <message>
        <source>Tests (*.toml)</source>
        <translation>Versuche (*.toml)</translation>
    </message>
    <message>
        <source>Tests in the folder</source>
        <translation>Versuche im Ordner</translation>
    </message>
    <message>
        <source>Tests of the queue</source>
        <translation>Versuche der Warteschlange</translation>
    </message>
    <message>
        <source>The &amp;load hangs still</source>
        <translation>Die &amp;Last hängt ruhig</translation>
    </message>
    <message>
        <source>The &amp;target stands before the probe</source>
        <translation>Das &amp;Ziel steht vor dem Wegsensor</translation>
    </message>
    <message>
        <source>The certificate is made from the record alone: the same bytes each time.</source>
        <translation>Der Kalibrierschein entsteht allein aus dem Datensatz: jedes Mal dieselben Bytes.</translation>
    </message>
    <message>
        <source>The certificate is {}.</source>
        <translation>Der Kalibrierschein ist {}.</translation>
    </message>
    <message>
        <source>The check failed</source>
        <translation>Die Prüfung ist nicht bestanden</translation>
    </message>
    <message>
        <source>The check is kept in {}.</source>
        <translation>Die Prüfung liegt in {}.</translation>
    </message>
    <message>
        <source>The chosen fault</source>
        <translation>Der gewählte Fehler</translation>
    </message>
    <message>
        <source>The chosen test</source>
        <translation>Der gewählte Versuch</translation>
    </message>
    <message>
        <source>The crank angle is unknown, so the drive was switched off.</source>
        <translation>Der Kurbelwinkel ist unbekannt; der Antrieb wurde abgeschaltet.</translation>
    </message>
    <message>
        <source>The daily check is passed</source>
        <translation>Die tägliche Prüfung ist bestanden</translation>
    </message>
    <message>
        <source>The deliberate action before another start: every critical alarm must be acknowledged and its cause gone. Nothing moves.</source>
        <translation>Der bewusste Schritt vor einem neuen Start: Jeder kritische Alarm muss quittiert und seine Ursache weg sein. Nichts bewegt sich.</translation>
    </message>
    <message>
        <source>The desktop has no program for {}; it is in {}</source>
        <translation>Es gibt kein Programm für {}; die Datei ist {}</translation>
    </message>
    <message>
        <source>The drive may switch off by itself soon.</source>
        <translation>Der Antrieb könnte bald selbst abschalten.</translation>
    </message>
    <message>
        <source>The drive was switched off and the test ended.</source>
        <translation>Der Antrieb wurde abgeschaltet und der Versuch beendet.</translation>
    </message>
    <message>
        <source>The drive was switched off to protect the load cell.</source>
        <translation>Der Antrieb wurde abgeschaltet, um den Kraftsensor zu schützen.</translation>
    </message>
    <message>
        <source>The drive was switched off.</source>
        <translation>Der Antrieb wurde abgeschaltet.</translation>
    </message>
    <message>
        <source>The duration</source>
        <translation>Die Dauer</translation>
    </message>
    <message>
        <source>The engine ended while {test} was {state}, and a new one was started. The drive&apos;s own watchdog stops the spindle. {saved} revolutions are safe in {file}. To go on with it: Results (Ctrl+8), Go on with it.</source>
        <translation>Die Steuerung ging zu Ende, während {test} im Zustand „{state}“ war; eine neue wurde gestartet. Der Wächter des Antriebs hält die Spindel selbst an. {saved} Umdrehungen sind sicher in {file}. Zum Fortsetzen: Ergebnisse (Strg+8), „Fortsetzen“.</translation>
    </message>
    <message>
        <source>The engine was shut down during the test</source>
        <translation>Die Steuerung wurde während des Versuchs beendet</translation>
    </message>
    <message>
        <source>The faults of the simulated rig are not known: {}</source>
        <translation>Die Fehler des simulierten Prüfstands sind nicht bekannt: {}</translation>
    </message>
    <message>
        <source>The first angle</source>
        <translation>Der erste Winkel</translation>
    </message>
    <message>
        <source>The first that is met ends the test; what is empty is off</source>
        <translation>Das erste erfüllte beendet den Versuch; was leer ist, ist aus</translation>
    </message>
    <message>
        <source>The force is not known, an overload would not be seen: the test was ended and the spindle stopped. The samples since then are flagged.</source>
        <translation>Die Kraft ist nicht bekannt, eine Überlast würde nicht bemerkt: Der Versuch wurde beendet und die Spindel angehalten. Die Messwerte seither sind gekennzeichnet.</translation>
    </message>
    <message>
        <source>The force is not known, so the drive was switched off.</source>
        <translation>Die Kraft ist nicht bekannt; der Antrieb wurde abgeschaltet.</translation>
    </message>
    <message>
        <source>The joint wears otherwise than before</source>
        <translation>Das Gelenk verschleißt anders als zuvor</translation>
    </message>
    <message>
        <source>The load cell sent a value that is not a number.</source>
        <translation>Der Kraftsensor sandte einen Wert, der keine Zahl ist.</translation>
    </message>
    <message>
        <source>The motor has no power; the test was ended.</source>
        <translation>Der Motor ist stromlos; der Versuch wurde beendet.</translation>
    </message>
    <message>
        <source>The open step</source>
        <translation>Der offene Schritt</translation>
    </message>
    <message>
        <source>The pin is &amp;turned</source>
        <translation>Der Bolzen ist &amp;gedreht</translation>
    </message>
    <message>
        <source>The plan and all readings are those of the journal.</source>
        <translation>Plan und alle Messungen sind die des Journals.</translation>
    </message>
    <message>
        <source>The preload is d&amp;one</source>
        <translation>Die V&amp;orlast ist getan</translation>
    </message>
    <message>
        <source>The queue has stopped</source>
        <translation>Die Warteschlange ist stehen geblieben</translation>
    </message>
    <message>
        <source>The queue stands; {} to be done.</source>
        <translation>Die Warteschlange steht; {} zu erledigen.</translation>
    </message>
    <message>
        <source>The queue works: the next test begins by itself; {} to be done.</source>
        <translation>Die Warteschlange arbeitet: der nächste Versuch beginnt von selbst; {} zu erledigen.</translation>
    </message>
    <message>
        <source>The record counts when {} names it: section [{}], {} = {}</source>
        <translation>Der Datensatz gilt, wenn {} ihn nennt: Abschnitt [{}], {} = {}</translation>
    </message>
    <message>
        <source>The record is saved and read-only: {}.</source>
        <translation>Der Datensatz ist gespeichert und schreibgeschützt: {}.</translation>
    </message>
    <message>
        <source>The revolutions concerned are flagged as gaps.</source>
        <translation>Die betroffenen Umdrehungen sind als Lücken gekennzeichnet.</translation>
    </message>
    <message>
        <source>The revolutions concerned are flagged.</source>
        <translation>Die betroffenen Umdrehungen sind gekennzeichnet.</translation>
    </message>
    <message>
        <source>The revolutions concerned are flagged; nothing is interpolated.</source>
        <translation>Die betroffenen Umdrehungen sind gekennzeichnet; nichts wird interpoliert.</translation>
    </message>
    <message>
        <source>The rig</source>
        <translation>Der Prüfstand</translation>
    </message>
    <message>
        <source>The spindle did not come to rest for the pause.</source>
        <translation>Die Spindel kam für die Pause nicht zur Ruhe.</translation>
    </message>
    <message>
        <source>The spindle turns for about {:.0f} min.</source>
        <translation>Die Spindel dreht sich etwa {:.0f} min.</translation>
    </message>
    <message>
        <source>The spindle turns slowly with the follower on the pin and an unworn bushing, whose probes then see the pin&apos;s own run-out. Two speeds tell inertia from run-out.</source>
        <translation>Die Spindel dreht langsam, mit der Koppel auf dem Bolzen und einer neuen Buchse; die Wegsensoren sehen dann den Rundlauf des Bolzens selbst. Zwei Drehzahlen trennen Trägheit und Rundlauf.</translation>
    </message>
    <message>
        <source>The spindle turns. Keep your hands away.</source>
        <translation>Die Spindel dreht sich. Hände weg.</translation>
    </message>
    <message>
        <source>The study has no table yet: it is under way, or was killed. What is done is safe, and the same command goes on with it</source>
        <translation>Die Studie hat noch keine Tabelle: sie läuft, oder wurde abgebrochen. Was fertig ist, ist sicher, und derselbe Befehl macht damit weiter</translation>
    </message>
    <message>
        <source>The test goes on and is recorded; windows may show nothing and cannot command it.</source>
        <translation>Der Versuch geht weiter und wird aufgezeichnet; Fenster zeigen vielleicht nichts und können ihn nicht bedienen.</translation>
    </message>
    <message>
        <source>The test goes on without this criterion.</source>
        <translation>Der Versuch geht ohne dieses Kriterium weiter.</translation>
    </message>
    <message>
        <source>The test goes on, its data wait in memory; after 20 s it would be stopped.</source>
        <translation>Der Versuch geht weiter, seine Daten warten im Speicher; nach 20 s würde er gestoppt.</translation>
    </message>
    <message>
        <source>The test goes on.</source>
        <translation>Der Versuch geht weiter.</translation>
    </message>
    <message>
        <source>The test goes on. Its data are kept only as long as this program runs; saving them is tried again every few seconds.</source>
        <translation>Der Versuch geht weiter. Seine Daten bleiben nur, solange dieses Programm läuft; alle paar Sekunden wird neu versucht, sie zu sichern.</translation>
    </message>
    <message>
        <source>The test goes on; remaining life and wear coefficient follow what is new slowly.</source>
        <translation>Der Versuch geht weiter; Restlebensdauer und Verschleißkoeffizient folgen dem Neuen langsam.</translation>
    </message>
    <message>
        <source>The test goes on; wear and friction may be of another kind than in the range.</source>
        <translation>Der Versuch geht weiter; Verschleiß und Reibung können anderer Art sein als im Bereich.</translation>
    </message>
    <message>
        <source>The test goes on; who is away may not be told what happens to it.</source>
        <translation>Der Versuch geht weiter; wer nicht da ist, erfährt vielleicht nicht, was geschieht.</translation>
    </message>
    <message>
        <source>The test pauses at the safe angle.</source>
        <translation>Der Versuch hält am sicheren Winkel an.</translation>
    </message>
    <message>
        <source>The test that runs goes on to its end; no other one begins</source>
        <translation>Der laufende Versuch geht bis zu seinem Ende; kein anderer beginnt</translation>
    </message>
    <message>
        <source>The test was ended and the spindle stopped.</source>
        <translation>Der Versuch wurde beendet und die Spindel angehalten.</translation>
    </message>
    <message>
        <source>The test was ended and the spindle stopped; the data so far are safe.</source>
        <translation>Der Versuch wurde beendet und die Spindel angehalten; die Daten bis hier sind sicher.</translation>
    </message>
    <message>
        <source>The test was ended; the committed revolutions are safe.</source>
        <translation>Der Versuch wurde beendet; die gesicherten Umdrehungen sind sicher.</translation>
    </message>
    <message>
        <source>The test was ended; the drive has taken or lost its power.</source>
        <translation>Der Versuch wurde beendet; der Antrieb hat sich stromlos geschaltet oder die Versorgung verloren.</translation>
    </message>
    <message>
        <source>The test was not started: the devices are not ready.</source>
        <translation>Der Versuch wurde nicht gestartet: Die Geräte sind nicht bereit.</translation>
    </message>
    <message>
        <source>The test was stopped, as its test file says.</source>
        <translation>Der Versuch wurde gestoppt, wie seine Versuchsdatei es verlangt.</translation>
    </message>
    <message>
        <source>The test was stopped.</source>
        <translation>Der Versuch wurde gestoppt.</translation>
    </message>
    <message>
        <source>The value</source>
        <translation>Der Wert</translation>
    </message>
    <message>
        <source>Their statistics are kept, their samples are not.</source>
        <translation>Ihre Kennwerte bleiben, ihre Messwerte nicht.</translation>
    </message>
    <message>
        <source>Then</source>
        <translation>Danach</translation>
    </message>
    <message>
        <source>There is no study in {}.</source>
        <translation>In {} ist keine Studie.</translation>
    </message>
    <message>
        <source>These faults happen in the simulated devices, on the wire or on the signals, not in the program: what you see is what a real fault would show.</source>
        <translation>Diese Fehler geschehen in den simulierten Geräten, auf der Leitung oder in den Signalen, nicht im Programm: Zu sehen ist, was ein wirklicher Fehler zeigen würde.</translation>
    </message>
    <message>
        <source>This is a replay: no rig is connected</source>
        <translation>Dies ist eine Wiedergabe: kein Prüfstand ist verbunden</translation>
    </message>
    <message>
        <source>This rig runs as fast as it can: choose {} for this fault.</source>
        <translation>Dieser Prüfstand läuft so schnell er kann: für diesen Fehler {} wählen.</translation>
    </message>
    <message>
        <source>Thu</source>
        <translation>Do</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>Title, specimen, file, operator, reason</source>
        <translation>Titel, Probe, Datei, Bediener, Grund</translation>
    </message>
    <message>
        <source>To do</source>
        <translation>Zu tun</translation>
    </message>
    <message>
        <source>Trends</source>
        <translation>Verläufe</translation>
    </message>
    <message>
        <source>Tripped</source>
        <translation>Ausgelöst</translation>
    </message>
    <message>
        <source>Try it</source>
        <translation>Ausprobieren</translation>
    </message>
    <message>
        <source>Try the simulated rig</source>
        <translation>Simulierten Prüfstand probieren</translation>
    </message>
    <message>
        <source>Tue</source>
        <translation>Di</translation>
    </message>
    <message>
        <source>Type how many revolutions the step has, or how many seconds.</source>
        <translation>Geben Sie ein, wie viele Umdrehungen der Schritt hat oder wie viele Sekunden.</translation>
    </message>
    <message>
        <source>Uncertainty</source>
        <translation>Unsicherheit</translation>
    </message>
    <message>
        <source>Understood</source>
        <translation>Verstanden</translation>
    </message>
    <message>
        <source>Unit of how long step {} is</source>
        <translation>Einheit der Länge von Schritt {}</translation>
    </message>
    <message>
        <source>Usable. Save it to arm it for a start.</source>
        <translation>Brauchbar. Speichern macht ihn startbereit.</translation>
    </message>
    <message>
        <source>Usable. {}{}</source>
        <translation>Brauchbar. {}{}</translation>
    </message>
    <message>
        <source>VIEWING ONLY: {name} is in command of this rig. Stopping a test and acknowledging alarms are possible all the same.</source>
        <translation>NUR ZUSEHEN: {name} hat das Kommando über diesen Prüfstand. Stoppen und Alarme quittieren geht trotzdem.</translation>
    </message>
    <message>
        <source>Value</source>
        <translation>Wert</translation>
    </message>
    <message>
        <source>Value and limit</source>
        <translation>Wert und Grenze</translation>
    </message>
    <message>
        <source>Value of the fault, empty: its default</source>
        <translation>Wert des Fehlers, leer: der übliche</translation>
    </message>
    <message>
        <source>Value, empty: default</source>
        <translation>Wert, leer: Vorgabe</translation>
    </message>
    <message>
        <source>Vector and other channels</source>
        <translation>Vektor und andere Kanäle</translation>
    </message>
    <message>
        <source>Verdict</source>
        <translation>Urteil</translation>
    </message>
    <message>
        <source>Viewing only</source>
        <translation>Nur zusehen</translation>
    </message>
    <message>
        <source>Viewing only: {}</source>
        <translation>Nur zusehen: {}</translation>
    </message>
    <message>
        <source>Voltages now</source>
        <translation>Spannungen jetzt</translation>
    </message>
    <message>
        <source>W&amp;eights (kg)</source>
        <translation>G&amp;ewichte (kg)</translation>
    </message>
    <message>
        <source>WAIT</source>
        <translation>WARTEN</translation>
    </message>
    <message>
        <source>Wait</source>
        <translation>Warten</translation>
    </message>
    <message>
        <source>Wait for the engine: which rig it drives is not known yet.</source>
        <translation>Auf die Steuerung warten: ihr Prüfstand ist noch nicht bekannt.</translation>
    </message>
    <message>
        <source>Wait: the crank comes to rest at the pause angle.</source>
        <translation>Warten: Die Kurbel kommt am Pausenwinkel zur Ruhe.</translation>
    </message>
    <message>
        <source>Wait: the devices are being connected.</source>
        <translation>Warten: Die Geräte werden verbunden.</translation>
    </message>
    <message>
        <source>Wait: the spindle is brought to a stand and the file is finished.</source>
        <translation>Warten: Die Spindel wird angehalten und die Datei abgeschlossen.</translation>
    </message>
    <message>
        <source>Warning above</source>
        <translation>Warnung über</translation>
    </message>
    <message>
        <source>Warning below</source>
        <translation>Warnung unter</translation>
    </message>
    <message>
        <source>Warnings of the device</source>
        <translation>Warnungen des Geräts</translation>
    </message>
    <message>
        <source>Watch</source>
        <translation>Betrieb</translation>
    </message>
    <message>
        <source>Way to the limit</source>
        <translation>Weg zur Grenze</translation>
    </message>
    <message>
        <source>Wear</source>
        <translation>Verschleiß</translation>
    </message>
    <message>
        <source>Wear coefficient</source>
        <translation>Verschleißkoeffizient</translation>
    </message>
    <message>
        <source>Wear coefficient by earlier tests: rigapp identify prints it</source>
        <translation>Verschleißkoeffizient aus früheren Versuchen: rigapp identify gibt ihn aus</translation>
    </message>
    <message>
        <source>Wear coefficient in 10⁻⁴ mm³/(N m)</source>
        <translation>Verschleißkoeffizient in 10⁻⁴ mm³/(N m)</translation>
    </message>
    <message>
        <source>Wear depth</source>
        <translation>Verschleißtiefe</translation>
    </message>
    <message>
        <source>Wear depth by the probes, with its expanded uncertainty (k = 2)</source>
        <translation>Verschleißtiefe der Wegsensoren mit erweiterter Unsicherheit (k = 2)</translation>
    </message>
    <message>
        <source>Wear law</source>
        <translation>Verschleißgesetz</translation>
    </message>
    <message>
        <source>Wed</source>
        <translation>Mi</translation>
    </message>
    <message>
        <source>Weights, kilograms; 5x8 are eight of 5 kg</source>
        <translation>Gewichte in Kilogramm; 5x8 sind acht von 5 kg</translation>
    </message>
    <message>
        <source>What happened</source>
        <translation>Was geschehen ist</translation>
    </message>
    <message>
        <source>What happens to the rig file</source>
        <translation>Was mit der Prüfstandsdatei geschieht</translation>
    </message>
    <message>
        <source>What is known of the wear</source>
        <translation>Was vom Verschleiß bekannt ist</translation>
    </message>
    <message>
        <source>What is positive</source>
        <translation>Was positiv ist</translation>
    </message>
    <message>
        <source>What is started</source>
        <translation>Was gestartet wird</translation>
    </message>
    <message>
        <source>What is wrong on this page</source>
        <translation>Was auf dieser Seite falsch ist</translation>
    </message>
    <message>
        <source>What is wrong with step {}, or where it is</source>
        <translation>Was an Schritt {} falsch ist oder wo er liegt</translation>
    </message>
    <message>
        <source>What it rests on</source>
        <translation>Worauf sie beruht</translation>
    </message>
    <message>
        <source>What it tells is not recorded until it answers; the test goes on.</source>
        <translation>Was es meldet, wird erst aufgezeichnet, wenn es antwortet; der Versuch geht weiter.</translation>
    </message>
    <message>
        <source>What shall be calibrated?</source>
        <translation>Was soll kalibriert werden?</translation>
    </message>
    <message>
        <source>What stands against it</source>
        <translation>Was dagegen spricht</translation>
    </message>
    <message>
        <source>What the control charts say</source>
        <translation>Was die Regelkarten sagen</translation>
    </message>
    <message>
        <source>What the file holds</source>
        <translation>Was die Datei enthält</translation>
    </message>
    <message>
        <source>What the number is</source>
        <translation>Was die Zahl ist</translation>
    </message>
    <message>
        <source>What the queue does</source>
        <translation>Was die Warteschlange tut</translation>
    </message>
    <message>
        <source>What the result depends on</source>
        <translation>Wovon das Ergebnis abhängt</translation>
    </message>
    <message>
        <source>What the result depends on most</source>
        <translation>Wovon das Ergebnis am meisten abhängt</translation>
    </message>
    <message>
        <source>What the study came to</source>
        <translation>Was die Studie ergeben hat</translation>
    </message>
    <message>
        <source>What the table of the power says</source>
        <translation>Was die Tabelle der Trennschärfe sagt</translation>
    </message>
    <message>
        <source>What these faults are</source>
        <translation>Was diese Fehler sind</translation>
    </message>
    <message>
        <source>What this input shows is cut off at the end of its range; its samples are flagged.</source>
        <translation>Was dieser Eingang zeigt, ist am Ende seines Bereichs abgeschnitten; seine Messwerte sind gekennzeichnet.</translation>
    </message>
    <message>
        <source>What this input shows is wrong as long as it is; the samples are flagged.</source>
        <translation>Was dieser Eingang zeigt, ist so lange falsch; die Messwerte sind gekennzeichnet.</translation>
    </message>
    <message>
        <source>What this input shows may be wrong.</source>
        <translation>Was dieser Eingang zeigt, kann falsch sein.</translation>
    </message>
    <message>
        <source>What this means</source>
        <translation>Was das bedeutet</translation>
    </message>
    <message>
        <source>What to do</source>
        <translation>Was zu tun ist</translation>
    </message>
    <message>
        <source>What to do now</source>
        <translation>Was jetzt zu tun ist</translation>
    </message>
    <message>
        <source>What was counted on the line</source>
        <translation>Was auf der Leitung gezählt wurde</translation>
    </message>
    <message>
        <source>What was found</source>
        <translation>Was gefunden wurde</translation>
    </message>
    <message>
        <source>What was looked at</source>
        <translation>Was geprüft wurde</translation>
    </message>
    <message>
        <source>Where</source>
        <translation>Wo</translation>
    </message>
    <message>
        <source>Where the certificate is</source>
        <translation>Wo der Kalibrierschein ist</translation>
    </message>
    <message>
        <source>Where the pairing may run: beyond, a warning; what is empty is off</source>
        <translation>Wo die Paarung laufen darf: darüber eine Warnung; was leer ist, ist aus</translation>
    </message>
    <message>
        <source>Where the record is</source>
        <translation>Wo der Datensatz ist</translation>
    </message>
    <message>
        <source>Where to begin</source>
        <translation>Womit beginnen</translation>
    </message>
    <message>
        <source>Where would you like to begin?</source>
        <translation>Womit möchten Sie beginnen?</translation>
    </message>
    <message>
        <source>Whether the result can be trusted</source>
        <translation>Ob dem Ergebnis zu trauen ist</translation>
    </message>
    <message>
        <source>Which probe</source>
        <translation>Welcher Wegsensor</translation>
    </message>
    <message>
        <source>Who</source>
        <translation>Wer</translation>
    </message>
    <message>
        <source>Who and what</source>
        <translation>Wer und was</translation>
    </message>
    <message>
        <source>Who is in command</source>
        <translation>Wer das Kommando hat</translation>
    </message>
    <message>
        <source>Whole cycles not kept</source>
        <translation>Ganze Zyklen nicht aufbewahrt</translation>
    </message>
    <message>
        <source>Whole cycles to keep</source>
        <translation>Ganze Zyklen, die bleiben</translation>
    </message>
    <message>
        <source>Why the fault cannot be caused</source>
        <translation>Warum der Fehler nicht ausgelöst werden kann</translation>
    </message>
    <message>
        <source>Why the limit cannot be changed</source>
        <translation>Warum die Grenze nicht geändert werden kann</translation>
    </message>
    <message>
        <source>Why the test ended</source>
        <translation>Warum der Versuch endete</translation>
    </message>
    <message>
        <source>Why there is no result</source>
        <translation>Warum es kein Ergebnis gibt</translation>
    </message>
    <message>
        <source>Why this window only looks</source>
        <translation>Warum dieses Fenster nur zusieht</translation>
    </message>
    <message>
        <source>Why was the test {}? Enter adds it to the log</source>
        <translation>Warum ist der Versuch im Zustand „{}“? Enter schreibt es ins Protokoll</translation>
    </message>
    <message>
        <source>Why?</source>
        <translation>Warum?</translation>
    </message>
    <message>
        <source>Window of the rig</source>
        <translation>Fenster des Prüfstands</translation>
    </message>
    <message>
        <source>Windows cannot be served</source>
        <translation>Fenster können nicht bedient werden</translation>
    </message>
    <message>
        <source>With all others</source>
        <translation>Mit allen anderen</translation>
    </message>
    <message>
        <source>Write</source>
        <translation>Schreiben</translation>
    </message>
    <message>
        <source>Write its name into the &amp;rig file…</source>
        <translation>Seinen Namen in die &amp;Prüfstandsdatei schreiben…</translation>
    </message>
    <message>
        <source>Write t&amp;o</source>
        <translation>&amp;Schreiben in</translation>
    </message>
    <message>
        <source>Write the certificate as &amp;HTML</source>
        <translation>Kalibrierschein als &amp;HTML schreiben</translation>
    </message>
    <message>
        <source>Write the certificate as &amp;PDF</source>
        <translation>Kalibrierschein als &amp;PDF schreiben</translation>
    </message>
    <message>
        <source>Write the name of the record into the rig file</source>
        <translation>Den Namen des Datensatzes in die Prüfstandsdatei schreiben</translation>
    </message>
    <message>
        <source>Write the name of this record into {}? Comments and all else stay, and a copy of the file as it is now is kept beside it.</source>
        <translation>Den Namen dieses Datensatzes in {} schreiben? Kommentare und alles andere bleiben, und eine Kopie der jetzigen Datei bleibt daneben.</translation>
    </message>
    <message>
        <source>Write the report of the test beside its file</source>
        <translation>Den Bericht des Versuchs neben seine Datei schreiben</translation>
    </message>
    <message>
        <source>Write the text into the log of the test (Enter)</source>
        <translation>Den Text ins Protokoll des Versuchs schreiben (Enter)</translation>
    </message>
    <message>
        <source>Write {}</source>
        <translation>{} schreiben</translation>
    </message>
    <message>
        <source>Write {} beside the test</source>
        <translation>{} neben den Versuch schreiben</translation>
    </message>
    <message>
        <source>Writing the certificate; the first one takes some seconds …</source>
        <translation>Der Kalibrierschein wird geschrieben; der erste braucht einige Sekunden …</translation>
    </message>
    <message>
        <source>Writing {} …</source>
        <translation>{} wird geschrieben …</translation>
    </message>
    <message>
        <source>Writing …</source>
        <translation>Schreibt …</translation>
    </message>
    <message>
        <source>You are in command</source>
        <translation>Sie haben das Kommando</translation>
    </message>
    <message>
        <source>Zero of axis 1</source>
        <translation>Nullpunkt der Achse 1</translation>
    </message>
    <message>
        <source>Zero of axis 2</source>
        <translation>Nullpunkt der Achse 2</translation>
    </message>
    <message>
        <source>Zero the load cell</source>
        <translation>Den Kraftsensor nullen</translation>
    </message>
    <message>
        <source>Zero, with its reason</source>
        <translation>Nullpunkt, mit Grund</translation>
    </message>
    <message>
        <source>a critical alarm whose condition is over; it forbids a start until it is acknowledged and reset</source>
        <translation>ein kritischer Alarm, dessen Bedingung vorbei ist; er verbietet einen Start, bis er quittiert und zurückgesetzt ist</translation>
    </message>
    <message>
        <source>a share of 1</source>
        <translation>ein Anteil von 1</translation>
    </message>
    <message>
        <source>a test</source>
        <translation>ein Versuch</translation>
    </message>
    <message>
        <source>a test is under way; stop it first</source>
        <translation>ein Versuch ist im Gang; ihn erst stoppen</translation>
    </message>
    <message>
        <source>a warning whose condition is over before anybody has acknowledged it; acknowledging takes it off the list</source>
        <translation>eine Warnung, deren Bedingung vorbei ist, bevor jemand sie quittiert hat; das Quittieren nimmt sie von der Liste</translation>
    </message>
    <message>
        <source>acknowledge</source>
        <translation>quittieren</translation>
    </message>
    <message>
        <source>acknowledged</source>
        <translation>quittiert</translation>
    </message>
    <message>
        <source>after the devices</source>
        <translation>nach den Geräten</translation>
    </message>
    <message>
        <source>after the engine</source>
        <translation>nach der Steuerung</translation>
    </message>
    <message>
        <source>all {} cycles are in the file</source>
        <translation>alle {} Zyklen stehen in der Datei</translation>
    </message>
    <message>
        <source>arrows</source>
        <translation>Pfeile</translation>
    </message>
    <message>
        <source>as asked</source>
        <translation>wie verlangt</translation>
    </message>
    <message>
        <source>as in the test</source>
        <translation>wie im Versuch</translation>
    </message>
    <message>
        <source>asked by the operator</source>
        <translation>vom Bediener verlangt</translation>
    </message>
    <message>
        <source>bars</source>
        <translation>Balken</translation>
    </message>
    <message>
        <source>before the start</source>
        <translation>vor dem Start</translation>
    </message>
    <message>
        <source>bound of the computed depth&apos;s error</source>
        <translation>Schranke für den Fehler der berechneten Tiefe</translation>
    </message>
    <message>
        <source>broken</source>
        <translation>gebrochen</translation>
    </message>
    <message>
        <source>by slow rolls of the spindle</source>
        <translation>durch langsame Umläufe der Spindel</translation>
    </message>
    <message>
        <source>by the probes, k = 2</source>
        <translation>von den Wegsensoren, k = 2</translation>
    </message>
    <message>
        <source>circle</source>
        <translation>Kreis</translation>
    </message>
    <message>
        <source>clear fault</source>
        <translation>Fehler beenden</translation>
    </message>
    <message>
        <source>complete</source>
        <translation>vollständig</translation>
    </message>
    <message>
        <source>connect</source>
        <translation>verbinden</translation>
    </message>
    <message>
        <source>connecting</source>
        <translation>Verbinden</translation>
    </message>
    <message>
        <source>crank angle of the largest |F|</source>
        <translation>Kurbelwinkel des größten |F|</translation>
    </message>
    <message>
        <source>critical</source>
        <translation>kritisch</translation>
    </message>
    <message>
        <source>cycle {} at {:.0f}°</source>
        <translation>Zyklus {} bei {:.0f}°</translation>
    </message>
    <message>
        <source>days</source>
        <translation>Tage</translation>
    </message>
    <message>
        <source>default</source>
        <translation>üblicher Wert</translation>
    </message>
    <message>
        <source>degrees</source>
        <translation>Grad</translation>
    </message>
    <message>
        <source>diamond</source>
        <translation>Raute</translation>
    </message>
    <message>
        <source>disturbed: {} samples lost, {} errors in the last minute</source>
        <translation>gestört: {} Werte verloren, {} Fehler in der letzten Minute</translation>
    </message>
    <message>
        <source>done</source>
        <translation>getan</translation>
    </message>
    <message>
        <source>drive off</source>
        <translation>Antrieb aus</translation>
    </message>
    <message>
        <source>driven wear depth</source>
        <translation>Verschleißtiefe aus der gemessenen Kraft</translation>
    </message>
    <message>
        <source>elastic approach of pin and bushing</source>
        <translation>elastische Annäherung von Bolzen und Buchse</translation>
    </message>
    <message>
        <source>ends {}</source>
        <translation>Ende {}</translation>
    </message>
    <message>
        <source>ends {}, in {}</source>
        <translation>Ende {}, in {}</translation>
    </message>
    <message>
        <source>examine file</source>
        <translation>Datei prüfen</translation>
    </message>
    <message>
        <source>extend</source>
        <translation>verlängern</translation>
    </message>
    <message>
        <source>fault</source>
        <translation>Störung</translation>
    </message>
    <message>
        <source>find, e.g. cable, spikes, daq</source>
        <translation>suchen, z. B. cable, spikes, daq</translation>
    </message>
    <message>
        <source>finding {}</source>
        <translation>{} wird gesucht</translation>
    </message>
    <message>
        <source>first</source>
        <translation>zuerst</translation>
    </message>
    <message>
        <source>from the calibration in the file</source>
        <translation>aus der Kalibrierung in der Datei</translation>
    </message>
    <message>
        <source>good</source>
        <translation>gut</translation>
    </message>
    <message>
        <source>good now; {} samples lost, {} errors before</source>
        <translation>jetzt gut; vorher {} Werte verloren, {} Fehler</translation>
    </message>
    <message>
        <source>good, nothing lost</source>
        <translation>gut, nichts verloren</translation>
    </message>
    <message>
        <source>half angle of the contact</source>
        <translation>halber Kontaktwinkel</translation>
    </message>
    <message>
        <source>half the limits&apos; distance over the median</source>
        <translation>halber Abstand der Grenzen durch den Median</translation>
    </message>
    <message>
        <source>hand</source>
        <translation>Hand</translation>
    </message>
    <message>
        <source>hello</source>
        <translation>Anmeldung</translation>
    </message>
    <message>
        <source>hidden for a limited time, with a reason; limits act all the same</source>
        <translation>für begrenzte Zeit verborgen, mit einem Grund; Grenzen wirken trotzdem</translation>
    </message>
    <message>
        <source>idle</source>
        <translation>Ruhe</translation>
    </message>
    <message>
        <source>in step {} only</source>
        <translation>nur in Schritt {}</translation>
    </message>
    <message>
        <source>inject fault</source>
        <translation>Fehler auslösen</translation>
    </message>
    <message>
        <source>interrupted</source>
        <translation>unterbrochen</translation>
    </message>
    <message>
        <source>it does not end</source>
        <translation>er endet nicht</translation>
    </message>
    <message>
        <source>its U</source>
        <translation>seine U</translation>
    </message>
    <message>
        <source>its mechanism tells the elastic motion, its limits stay</source>
        <translation>sein Getriebe sagt die elastische Bewegung, seine Grenzen bleiben</translation>
    </message>
    <message>
        <source>kilograms</source>
        <translation>Kilogramm</translation>
    </message>
    <message>
        <source>largest contact pressure</source>
        <translation>größter Kontaktdruck</translation>
    </message>
    <message>
        <source>largest magnitude of the drive&apos;s torque</source>
        <translation>größter Betrag des Antriebsmoments</translation>
    </message>
    <message>
        <source>largest |F| of the joint</source>
        <translation>größtes |F| des Gelenks</translation>
    </message>
    <message>
        <source>latched</source>
        <translation>gehalten</translation>
    </message>
    <message>
        <source>later</source>
        <translation>später</translation>
    </message>
    <message>
        <source>least margin {:.0f} %, {}</source>
        <translation>kleinster Abstand {:.0f} %, {}</translation>
    </message>
    <message>
        <source>limit of the history</source>
        <translation>Grenze aus der Vorgeschichte</translation>
    </message>
    <message>
        <source>limits are changed in the test file while no test is under way</source>
        <translation>ohne laufenden Versuch werden Grenzen in der Versuchsdatei geändert</translation>
    </message>
    <message>
        <source>lower 95 % limit of it</source>
        <translation>untere 95-%-Grenze davon</translation>
    </message>
    <message>
        <source>lower 95 % limit of them</source>
        <translation>untere 95-%-Grenze davon</translation>
    </message>
    <message>
        <source>making the ports</source>
        <translation>Anschlüsse werden angelegt</translation>
    </message>
    <message>
        <source>margin {:.0f} %</source>
        <translation>Abstand {:.0f} %</translation>
    </message>
    <message>
        <source>mean force over the slip at the end</source>
        <translation>mittlere Kraft über den Gleitweg am Ende</translation>
    </message>
    <message>
        <source>measured by the probes, k = 2</source>
        <translation>von den Wegsensoren, k = 2</translation>
    </message>
    <message>
        <source>measured wear depth</source>
        <translation>gemessene Verschleißtiefe</translation>
    </message>
    <message>
        <source>measured wear depth uncertainty</source>
        <translation>Unsicherheit der gemessenen Verschleißtiefe</translation>
    </message>
    <message>
        <source>metres per second squared</source>
        <translation>Meter pro Sekunde zum Quadrat</translation>
    </message>
    <message>
        <source>micrometres</source>
        <translation>Mikrometer</translation>
    </message>
    <message>
        <source>mind</source>
        <translation>beachten</translation>
    </message>
    <message>
        <source>name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>next</source>
        <translation>als Nächstes</translation>
    </message>
    <message>
        <source>no data yet</source>
        <translation>noch keine Daten</translation>
    </message>
    <message>
        <source>no devices are connected; connect first</source>
        <translation>keine Geräte sind verbunden; erst verbinden</translation>
    </message>
    <message>
        <source>no drive is connected</source>
        <translation>kein Antrieb ist verbunden</translation>
    </message>
    <message>
        <source>no force was recorded</source>
        <translation>keine Kraft aufgezeichnet</translation>
    </message>
    <message>
        <source>no prediction</source>
        <translation>keine Vorhersage</translation>
    </message>
    <message>
        <source>no signals from the engine</source>
        <translation>keine Signale von der Steuerung</translation>
    </message>
    <message>
        <source>no test</source>
        <translation>kein Versuch</translation>
    </message>
    <message>
        <source>no test running</source>
        <translation>kein Versuch läuft</translation>
    </message>
    <message>
        <source>no warning</source>
        <translation>keine Warnung</translation>
    </message>
    <message>
        <source>none: the fields below are enough</source>
        <translation>keine: die Felder unten genügen</translation>
    </message>
    <message>
        <source>not computed yet</source>
        <translation>noch nicht berechnet</translation>
    </message>
    <message>
        <source>not connected</source>
        <translation>nicht verbunden</translation>
    </message>
    <message>
        <source>not connected yet</source>
        <translation>noch nicht verbunden</translation>
    </message>
    <message>
        <source>not in time</source>
        <translation>nicht rechtzeitig</translation>
    </message>
    <message>
        <source>not known</source>
        <translation>nicht bekannt</translation>
    </message>
    <message>
        <source>not known yet: too little wear</source>
        <translation>noch nicht bekannt: zu wenig Verschleiß</translation>
    </message>
    <message>
        <source>not measured</source>
        <translation>nicht gemessen</translation>
    </message>
    <message>
        <source>not measured yet</source>
        <translation>noch nicht gemessen</translation>
    </message>
    <message>
        <source>not readable</source>
        <translation>nicht lesbar</translation>
    </message>
    <message>
        <source>note</source>
        <translation>Notiz</translation>
    </message>
    <message>
        <source>nothing judged yet</source>
        <translation>noch nichts beurteilt</translation>
    </message>
    <message>
        <source>now</source>
        <translation>jetzt</translation>
    </message>
    <message>
        <source>overload</source>
        <translation>Überlast</translation>
    </message>
    <message>
        <source>overspeed</source>
        <translation>Überdrehzahl</translation>
    </message>
    <message>
        <source>pause</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>paused</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>pausing</source>
        <translation>Anhalten</translation>
    </message>
    <message>
        <source>present</source>
        <translation>vorhanden</translation>
    </message>
    <message>
        <source>probes, k = 2</source>
        <translation>Wegsensoren, k = 2</translation>
    </message>
    <message>
        <source>queue add</source>
        <translation>zur Warteschlange</translation>
    </message>
    <message>
        <source>queue remove</source>
        <translation>aus der Warteschlange</translation>
    </message>
    <message>
        <source>queue start</source>
        <translation>Warteschlange beginnen</translation>
    </message>
    <message>
        <source>queue stop</source>
        <translation>Warteschlange anhalten</translation>
    </message>
    <message>
        <source>ready</source>
        <translation>bereit</translation>
    </message>
    <message>
        <source>real seconds</source>
        <translation>echte Sekunden</translation>
    </message>
    <message>
        <source>reason for shelving</source>
        <translation>Grund des Zurückstellens</translation>
    </message>
    <message>
        <source>reason, e.g. pin unloaded, new specimen</source>
        <translation>Grund, z. B. Bolzen entlastet, neue Probe</translation>
    </message>
    <message>
        <source>reason, goes into the log</source>
        <translation>Grund, kommt ins Protokoll</translation>
    </message>
    <message>
        <source>reconnect</source>
        <translation>neu verbinden</translation>
    </message>
    <message>
        <source>rejected: {}</source>
        <translation>verworfen: {}</translation>
    </message>
    <message>
        <source>release command</source>
        <translation>Kommando abgeben</translation>
    </message>
    <message>
        <source>reset</source>
        <translation>zurücksetzen</translation>
    </message>
    <message>
        <source>residual</source>
        <translation>Abweichung</translation>
    </message>
    <message>
        <source>residual 1</source>
        <translation>Abweichung 1</translation>
    </message>
    <message>
        <source>residual 2</source>
        <translation>Abweichung 2</translation>
    </message>
    <message>
        <source>resume</source>
        <translation>fortsetzen</translation>
    </message>
    <message>
        <source>resume file</source>
        <translation>Versuch fortsetzen</translation>
    </message>
    <message>
        <source>returned</source>
        <translation>zurückgekehrt</translation>
    </message>
    <message>
        <source>revolution from which the limits leave out the model&apos;s coefficient, to the end; none where they do not</source>
        <translation>Umdrehung, von der an die Grenzen den Koeffizienten des Modells bis zum Ende ausschließen; keine, wo sie es nicht tun</translation>
    </message>
    <message>
        <source>revolutions</source>
        <translation>Umdrehungen</translation>
    </message>
    <message>
        <source>revolutions to the depth of the end</source>
        <translation>Umdrehungen bis zur Endtiefe</translation>
    </message>
    <message>
        <source>revolutions {} to {}, ramp {}</source>
        <translation>Umdrehungen {} bis {}, Rampe {}</translation>
    </message>
    <message>
        <source>revolutions/h</source>
        <translation>Umdrehungen/h</translation>
    </message>
    <message>
        <source>revolutions/s</source>
        <translation>Umdrehungen/s</translation>
    </message>
    <message>
        <source>run.rpm = 0: give a speed other than 0</source>
        <translation>run.rpm = 0: eine andere Drehzahl als 0 angeben</translation>
    </message>
    <message>
        <source>running</source>
        <translation>läuft</translation>
    </message>
    <message>
        <source>set limit</source>
        <translation>Grenze setzen</translation>
    </message>
    <message>
        <source>shelve</source>
        <translation>zurückstellen</translation>
    </message>
    <message>
        <source>shelved</source>
        <translation>zurückgestellt</translation>
    </message>
    <message>
        <source>shutdown</source>
        <translation>beenden</translation>
    </message>
    <message>
        <source>signals</source>
        <translation>Signale</translation>
    </message>
    <message>
        <source>simulated</source>
        <translation>simuliert</translation>
    </message>
    <message>
        <source>simulated seconds</source>
        <translation>simulierte Sekunden</translation>
    </message>
    <message>
        <source>simulation state</source>
        <translation>Stand der Simulation</translation>
    </message>
    <message>
        <source>slip of a cycle</source>
        <translation>Gleitweg eines Umlaufs</translation>
    </message>
    <message>
        <source>smallest |F| of the joint</source>
        <translation>kleinstes |F| des Gelenks</translation>
    </message>
    <message>
        <source>square</source>
        <translation>Quadrat</translation>
    </message>
    <message>
        <source>stale for {}</source>
        <translation>veraltet seit {}</translation>
    </message>
    <message>
        <source>stands</source>
        <translation>gilt</translation>
    </message>
    <message>
        <source>start</source>
        <translation>starten</translation>
    </message>
    <message>
        <source>start: waiting for the devices …</source>
        <translation>Start: warte auf die Geräte …</translation>
    </message>
    <message>
        <source>starting</source>
        <translation>Anlauf</translation>
    </message>
    <message>
        <source>status</source>
        <translation>Stand</translation>
    </message>
    <message>
        <source>step {} of {}</source>
        <translation>Schritt {} von {}</translation>
    </message>
    <message>
        <source>stop</source>
        <translation>stoppen</translation>
    </message>
    <message>
        <source>stopped</source>
        <translation>gestoppt</translation>
    </message>
    <message>
        <source>stopped by operator</source>
        <translation>vom Bediener angehalten</translation>
    </message>
    <message>
        <source>stopped the test</source>
        <translation>hat den Versuch gestoppt</translation>
    </message>
    <message>
        <source>stopping</source>
        <translation>Auslauf</translation>
    </message>
    <message>
        <source>switched the drive off</source>
        <translation>hat den Antrieb ausgeschaltet</translation>
    </message>
    <message>
        <source>take command</source>
        <translation>Kommando nehmen</translation>
    </message>
    <message>
        <source>the condition holds, and nobody has acknowledged it</source>
        <translation>die Bedingung gilt, und niemand hat sie quittiert</translation>
    </message>
    <message>
        <source>the condition holds, and somebody has acknowledged it</source>
        <translation>die Bedingung gilt, und jemand hat sie quittiert</translation>
    </message>
    <message>
        <source>the connection to the devices is broken; connect first</source>
        <translation>die Verbindung zu den Geräten ist unterbrochen; erst verbinden</translation>
    </message>
    <message>
        <source>the critical alarm that came first since the last reset: look there first</source>
        <translation>der kritische Alarm, der seit dem letzten Zurücksetzen zuerst kam: dort zuerst nachsehen</translation>
    </message>
    <message>
        <source>the drive itself warns, as a rule of its supply, temperature or load; what is damaged on its line is counted beside the device and is no warning</source>
        <translation>der Antrieb selbst warnt, meist vor seiner Versorgung, Temperatur oder Last; was auf seiner Leitung beschädigt wird, ist beim Gerät gezählt und keine Warnung</translation>
    </message>
    <message>
        <source>the end waits</source>
        <translation>das Ende wartet</translation>
    </message>
    <message>
        <source>the load cell</source>
        <translation>den Kraftsensor</translation>
    </message>
    <message>
        <source>the log of this test has no room left for notes; alarms are still kept</source>
        <translation>das Protokoll dieses Versuchs hat keinen Platz mehr für Notizen; Alarme werden weiter aufgezeichnet</translation>
    </message>
    <message>
        <source>the note is empty</source>
        <translation>die Notiz ist leer</translation>
    </message>
    <message>
        <source>the number of revolutions is changed while a test runs or is paused</source>
        <translation>die Zahl der Umdrehungen wird geändert, während ein Versuch läuft oder in Pause ist</translation>
    </message>
    <message>
        <source>the operator</source>
        <translation>der Bediener</translation>
    </message>
    <message>
        <source>the other probe</source>
        <translation>des anderen Wegsensors</translation>
    </message>
    <message>
        <source>the pin moves across the follower, counter-clockwise</source>
        <translation>der Bolzen bewegt sich quer zur Koppel, gegen den Uhrzeigersinn</translation>
    </message>
    <message>
        <source>the pin moves along the follower towards the slider</source>
        <translation>der Bolzen bewegt sich längs der Koppel zum Schieber</translation>
    </message>
    <message>
        <source>the pin&apos;s run-out</source>
        <translation>den Rundlauf des Bolzens</translation>
    </message>
    <message>
        <source>the probes</source>
        <translation>die Wegsensoren</translation>
    </message>
    <message>
        <source>the rig file</source>
        <translation>die Prüfstandsdatei</translation>
    </message>
    <message>
        <source>the tare is set</source>
        <translation>der Nullpunkt ist gesetzt</translation>
    </message>
    <message>
        <source>these are no measurements</source>
        <translation>dies sind keine Messungen</translation>
    </message>
    <message>
        <source>they come</source>
        <translation>sie kommen</translation>
    </message>
    <message>
        <source>this is looked at</source>
        <translation>danach wird gesehen</translation>
    </message>
    <message>
        <source>this record</source>
        <translation>dieser Datensatz</translation>
    </message>
    <message>
        <source>to do</source>
        <translation>zu tun</translation>
    </message>
    <message>
        <source>triangle</source>
        <translation>Dreieck</translation>
    </message>
    <message>
        <source>tripped</source>
        <translation>ausgelöst</translation>
    </message>
    <message>
        <source>u of the &amp;micrometer</source>
        <translation>u der &amp;Messschraube</translation>
    </message>
    <message>
        <source>unacknowledged</source>
        <translation>unquittiert</translation>
    </message>
    <message>
        <source>until ended</source>
        <translation>bis zum Beenden</translation>
    </message>
    <message>
        <source>upper 95 % limit of it</source>
        <translation>obere 95-%-Grenze davon</translation>
    </message>
    <message>
        <source>upper 95 % limit of them</source>
        <translation>obere 95-%-Grenze davon</translation>
    </message>
    <message>
        <source>use records</source>
        <translation>Kalibrierung verwenden</translation>
    </message>
    <message>
        <source>waiting</source>
        <translation>wartet</translation>
    </message>
    <message>
        <source>warning</source>
        <translation>Warnung</translation>
    </message>
    <message>
        <source>was {}; {}</source>
        <translation>war: {}; {}</translation>
    </message>
    <message>
        <source>wear coefficient, median</source>
        <translation>Verschleißkoeffizient, Median</translation>
    </message>
    <message>
        <source>wear depth at the end</source>
        <translation>Verschleißtiefe am Ende</translation>
    </message>
    <message>
        <source>what the calibration says</source>
        <translation>was die Kalibrierung sagt</translation>
    </message>
    <message>
        <source>when (UTC)         sensitivity  cross-talk   largest N  verdict  operator</source>
        <translation>Zeit (UTC)         Empfindlichkeit  Übersprechen   größte N  Urteil  Bediener</translation>
    </message>
    <message>
        <source>why the selected reading does not count</source>
        <translation>warum die gewählte Messung nicht zählt</translation>
    </message>
    <message>
        <source>with a micrometer across the follower</source>
        <translation>mit einer Messschraube quer zur Koppel</translation>
    </message>
    <message>
        <source>with a micrometer along the follower</source>
        <translation>mit einer Messschraube längs der Koppel</translation>
    </message>
    <message>
        <source>with a micrometer stage; finds how the probes stand as well</source>
        <translation>mit einem Messtisch; findet auch, wie die Wegsensoren stehen</translation>
    </message>
    <message>
        <source>with weights, at several pin angles</source>
        <translation>mit Gewichten, bei mehreren Bolzenwinkeln</translation>
    </message>
    <message>
        <source>worn area at the end</source>
        <translation>verschlissene Fläche am Ende</translation>
    </message>
    <message>
        <source>worn mass at the end</source>
        <translation>verschlissene Masse am Ende</translation>
    </message>
    <message>
        <source>zero</source>
        <translation>nullen</translation>
    </message>
    <message>
        <source>{:.1f} of {:.1f} rpm</source>
        <translation>{:.1f} von {:.1f} rpm</translation>
    </message>
    <message>
        <source>{:g} times</source>
        <translation>{:g}-fach</translation>
    </message>
    <message>
        <source>{name} is in command</source>
        <translation>{name} hat das Kommando</translation>
    </message>
    <message>
        <source>{name} is in command of this rig; take command over first</source>
        <translation>{name} hat das Kommando über diesen Prüfstand; zuerst das Kommando übernehmen</translation>
    </message>
    <message>
        <source>{name} loses command; it is recorded in the log</source>
        <translation>{name} verliert das Kommando; das Protokoll hält es fest</translation>
    </message>
    <message>
        <source>{name} {length} {kind} at {speed_rpm} rpm, then rest {rest_s} s</source>
        <translation>{name} {length} {kind} mit {speed_rpm} rpm, dann {rest_s} s Ruhe</translation>
    </message>
    <message>
        <source>{} % ({} to {})</source>
        <translation>{} % ({} bis {})</translation>
    </message>
    <message>
        <source>{} above limit</source>
        <translation>{} über der Grenze</translation>
    </message>
    <message>
        <source>{} below limit</source>
        <translation>{} unter der Grenze</translation>
    </message>
    <message>
        <source>{} cannot be read: {}</source>
        <translation>{} ist nicht lesbar: {}</translation>
    </message>
    <message>
        <source>{} cannot be started: {}.</source>
        <translation>{} lässt sich nicht starten: {}.</translation>
    </message>
    <message>
        <source>{} cycles are safe; it can be resumed</source>
        <translation>{} Zyklen sind sicher; er lässt sich fortsetzen</translation>
    </message>
    <message>
        <source>{} gaps, {} of {} cycles flagged</source>
        <translation>{} Lücken, {} von {} Zyklen gekennzeichnet</translation>
    </message>
    <message>
        <source>{} good, {} for attention, {} block</source>
        <translation>{} gut, {} zu beachten, {} sperren</translation>
    </message>
    <message>
        <source>{} in short</source>
        <translation>{} in Kürze</translation>
    </message>
    <message>
        <source>{} in {} steps</source>
        <translation>{} in {} Schritten</translation>
    </message>
    <message>
        <source>{} is a real rig. The simulated one opens beside it.</source>
        <translation>{} ist ein echter Prüfstand. Der simulierte öffnet sich daneben.</translation>
    </message>
    <message>
        <source>{} is another one on the disk now: {}</source>
        <translation>{} ist auf der Platte jetzt eine andere: {}</translation>
    </message>
    <message>
        <source>{} is armed as it is saved.</source>
        <translation>{} ist scharf, wie gespeichert.</translation>
    </message>
    <message>
        <source>{} is armed as it is saved. Not part of it: {}</source>
        <translation>{} ist scharf, wie gespeichert. Nicht dabei: {}</translation>
    </message>
    <message>
        <source>{} is armed as it is saved. One draft limit is not part of it.</source>
        <translation>{} ist scharf, wie gespeichert. Eine Grenze im Entwurf gehört nicht dazu.</translation>
    </message>
    <message>
        <source>{} is in {}</source>
        <translation>{} ist in {}</translation>
    </message>
    <message>
        <source>{} is not written yet</source>
        <translation>{} ist noch nicht geschrieben</translation>
    </message>
    <message>
        <source>{} is not written: {}</source>
        <translation>{} ist nicht geschrieben: {}</translation>
    </message>
    <message>
        <source>{} is simulated: nothing real turns.</source>
        <translation>{} ist simuliert: nichts Echtes dreht sich.</translation>
    </message>
    <message>
        <source>{} is {}, above the {} limit {}.</source>
        <translation>{} ist {}, über der Grenze ({}) von {}.</translation>
    </message>
    <message>
        <source>{} is {}, below the {} limit {}.</source>
        <translation>{} ist {}, unter der Grenze ({}) von {}.</translation>
    </message>
    <message>
        <source>{} must be a number, not {}.</source>
        <translation>{} muss eine Zahl sein, nicht {}.</translation>
    </message>
    <message>
        <source>{} names the record now; the former file is {}.</source>
        <translation>{} nennt jetzt den Datensatz; die frühere Datei ist {}.</translation>
    </message>
    <message>
        <source>{} of the steps cannot be used.</source>
        <translation>{} der Schritte sind nicht verwendbar.</translation>
    </message>
    <message>
        <source>{} of {}</source>
        <translation>{} von {}</translation>
    </message>
    <message>
        <source>{} of {} cycles</source>
        <translation>{} von {} Zyklen</translation>
    </message>
    <message>
        <source>{} of {} points have a result. Why the others have none stands below.</source>
        <translation>{} von {} Punkten haben ein Ergebnis. Warum die anderen keines haben, steht unten.</translation>
    </message>
    <message>
        <source>{} of {} points have a result; still to come: {}; without a result: {}.</source>
        <translation>{} von {} Punkten haben ein Ergebnis; noch zu rechnen: {}; ohne Ergebnis: {}.</translation>
    </message>
    <message>
        <source>{} of {} tests in {}</source>
        <translation>{} von {} Versuchen in {}</translation>
    </message>
    <message>
        <source>{} on {}</source>
        <translation>{} an {}</translation>
    </message>
    <message>
        <source>{} pieces, {:g} kg in all. The heaviest load is {:g} kg; {}</source>
        <translation>{} Stücke, zusammen {:g} kg. Die schwerste Last ist {:g} kg; {}</translation>
    </message>
    <message>
        <source>{} points, each with a result.</source>
        <translation>{} Punkte, jeder mit einem Ergebnis.</translation>
    </message>
    <message>
        <source>{} readings, about {}.</source>
        <translation>{} Messungen, etwa {}.</translation>
    </message>
    <message>
        <source>{} refused: {}</source>
        <translation>{} abgelehnt: {}</translation>
    </message>
    <message>
        <source>{} saved</source>
        <translation>{} sicher</translation>
    </message>
    <message>
        <source>{} still to be read; {}</source>
        <translation>{} noch zu lesen; {}</translation>
    </message>
    <message>
        <source>Studies in {}: {}</source>
        <translation>Studien in {}: {}</translation>
    </message>
    <message>
        <source>{} tests in {} cannot be read: {}</source>
        <translation>{} Versuche in {} sind nicht lesbar: {}</translation>
    </message>
    <message>
        <source>{} to {}, half of them below {}</source>
        <translation>{} bis {}, die Hälfte unter {}</translation>
    </message>
    <message>
        <source>{} to {}, {}</source>
        <translation>{} bis {}, {}</translation>
    </message>
    <message>
        <source>{}, armed</source>
        <translation>{}, scharf</translation>
    </message>
    <message>
        <source>{}, cycle {}</source>
        <translation>{}, Zyklus {}</translation>
    </message>
    <message>
        <source>{}, detail</source>
        <translation>{}, Einzelheit</translation>
    </message>
    <message>
        <source>{}, {} new</source>
        <translation>{}, {} neu</translation>
    </message>
    <message>
        <source>{}, {} samples/s</source>
        <translation>{}, {} Werte/s</translation>
    </message>
    <message>
        <source>{}. Not now. {}</source>
        <translation>{}. Nicht jetzt. {}</translation>
    </message>
    <message>
        <source>{}. Not now: the state is {}; it must be {}</source>
        <translation>{}. Nicht jetzt: Der Zustand ist „{}“; er muss „{}“ sein</translation>
    </message>
    <message>
        <source>{}: done. {}</source>
        <translation>{}: getan. {}</translation>
    </message>
    <message>
        <source>{}: no rig is connected, nothing moves.</source>
        <translation>{}: kein Prüfstand ist verbunden, nichts bewegt sich.</translation>
    </message>
    <message>
        <source>{}; trying again</source>
        <translation>{}; neuer Versuch läuft</translation>
    </message>
    <message>
        <source>{}; {} cycles kept whole; changed {}</source>
        <translation>{}; {} Zyklen ganz behalten; geändert {}</translation>
    </message>
    <message>
        <source>|F| RMS</source>
        <translation>|F| RMS</translation>
    </message>
    <message>
        <source>|F| max, N</source>
        <translation>|F| max., N</translation>
    </message>
    <message>
        <source>|F| maximum</source>
        <translation>|F| Maximum</translation>
    </message>
    <message>
        <source>|F| now</source>
        <translation>|F| jetzt</translation>
    </message>
    <message>
        <source>µm, to the planned end; bands 95 %</source>
        <translation>µm, bis zum geplanten Ende; Bänder 95 %</translation>
    </message>
    <message>
        <source>▲ Attention</source>
        <translation>▲ Achtung</translation>
    </message>
    <message>
        <source>▲ Warning</source>
        <translation>▲ Warnung</translation>
    </message>
    <message>
        <source>▲ pressed</source>
        <translation>▲ gedrückt</translation>
    </message>
    <message>
        <source>◆ Critical</source>
        <translation>◆ Kritisch</translation>
    </message>
    <message>
        <source>◆ Not connected</source>
        <translation>◆ Nicht verbunden</translation>
    </message>
    <message>
        <source>✓ Good</source>
        <translation>✓ Gut</translation>
    </message>
    <message>
        <source>✗ The check is passed, but the cell changes</source>
        <translation>✗ Die Prüfung ist bestanden, aber der Sensor ändert sich</translation>
    </message>
    <message>
        <source>✗ There is no result</source>
        <translation>✗ Es gibt kein Ergebnis</translation>
    </message>
</context>
<context>
    <name>told</name>
    <message>
        <source>&quot;{}&quot; is on the alarm list: acknowledge and reset it first</source>
        <translation>„{}“ steht auf der Alarmliste: erst quittieren und zurücksetzen</translation>
    </message>
    <message>
        <source># rejected ({}): {}</source>
        <translation># verworfen ({}): {}</translation>
    </message>
    <message>
        <source>--plan {}: choose {}</source>
        <translation>--plan {}: zu wählen ist {}</translation>
    </message>
    <message>
        <source>--probe {}: choose {}</source>
        <translation>--probe {}: zu wählen ist {}</translation>
    </message>
    <message>
        <source>Acknowledge &quot;{}&quot; and {} more: say that you have seen it.</source>
        <translation>„{}“ und {} weitere quittieren: bestätigen, dass es gesehen wurde.</translation>
    </message>
    <message>
        <source>Acknowledge &quot;{}&quot;: say that you have seen it.</source>
        <translation>„{}“ quittieren: bestätigen, dass es gesehen wurde.</translation>
    </message>
    <message>
        <source>Calibration of {}</source>
        <translation>Kalibrierung: {}</translation>
    </message>
    <message>
        <source>Changed at revolution {:.0f} ({:.0f} to {:.0f}): the wear coefficient was {} before and is {} since</source>
        <translation>Geändert bei Umdrehung {} ({} bis {}): Der Verschleißkoeffizient war vorher {} und ist seither {}</translation>
    </message>
    <message>
        <source>Channel {}</source>
        <translation>Kanal {}</translation>
    </message>
    <message>
        <source>Circle: axis 1, triangle: axis 2. Last {} N; largest {:.2f} N at reading {} of those that stand</source>
        <translation>Kreis: Achse 1, Dreieck: Achse 2. Letzte {} N; größte {} N bei Messung {} von denen, die gelten</translation>
    </message>
    <message>
        <source>Circle: probe 1, triangle: probe 2. Last {:+.2f} µm; largest {:+.2f} µm at {:g} µm of probe {}</source>
        <translation>Kreis: Wegsensor 1, Dreieck: Wegsensor 2. Letzte {} µm; größte {} µm bei {} µm von Wegsensor {}</translation>
    </message>
    <message>
        <source>Coming back reads {:+.3f} um against going out</source>
        <translation>Der Rückweg zeigt {} um gegenüber dem Hinweg</translation>
    </message>
    <message>
        <source>Creep: from no load, {} Hang it without a pause, and go on as soon as it hangs still: from then on the time counts</source>
        <translation>Kriechen: ohne Last beginnen, {} Ohne Pause anhängen und fortfahren, sobald es ruhig hängt: Von da an zählt die Zeit</translation>
    </message>
    <message>
        <source>Device {}</source>
        <translation>Gerät {}</translation>
    </message>
    <message>
        <source>Elastic motion of the pin with the force, by the model of the unworn bushing, taken off: up to {:.2f} um about its mean</source>
        <translation>Elastische Bewegung des Bolzens mit der Kraft, nach dem Modell der neuen Buchse, abgezogen: bis {} um um ihr Mittel</translation>
    </message>
    <message>
        <source>Expanded uncertainty at {:g} N: {:.2f} N (k = {:.2f}); U(F) = {:.2f} N + {:.5f} F</source>
        <translation>Erweiterte Unsicherheit bei {} N: {} N (k = {}); U(F) = {} N + {} F</translation>
    </message>
    <message>
        <source>Force on the pin = matrix (signal - zero), pin frame; matrix in N per {}</source>
        <translation>Kraft auf den Bolzen = Matrix (Signal - Nullpunkt), Bezugssystem Bolzen; Matrix in N je {}</translation>
    </message>
    <message>
        <source>Free {:.0f} MB or keep fewer whole cycles</source>
        <translation>{} MB frei machen oder weniger ganze Zyklen behalten</translation>
    </message>
    <message>
        <source>Go on with the test in {}, or start another one.</source>
        <translation>Den Versuch in {} fortsetzen oder einen anderen starten.</translation>
    </message>
    <message>
        <source>In revolution {revolution} the count at the index differs from a whole turn.</source>
        <translation>In Umdrehung {revolution} weicht die Zählung am Index von einer ganzen Umdrehung ab.</translation>
    </message>
    <message>
        <source>Input saturated: {}</source>
        <translation>Eingang übersteuert: {}</translation>
    </message>
    <message>
        <source>Input {kind}</source>
        <translation>Eingang: {kind}</translation>
    </message>
    <message>
        <source>Leave the {:g} kg hanging: they are read after {:g} s</source>
        <translation>Die {} kg hängen lassen: Sie werden nach {} s gelesen</translation>
    </message>
    <message>
        <source>Linearity {:.3f} % of the range; expanded uncertainty {:.2f} um (k = {:.2f})</source>
        <translation>Linearität {} % des Bereichs; erweiterte Unsicherheit {} um (k = {})</translation>
    </message>
    <message>
        <source>Load cell input saturated: {}</source>
        <translation>Eingang des Kraftsensors übersteuert: {}</translation>
    </message>
    <message>
        <source>Lower the speed: {}</source>
        <translation>die Drehzahl senken: {}</translation>
    </message>
    <message>
        <source>Motion with the speed, taken off the slowest roll: up to {:.2f} um</source>
        <translation>Bewegung mit der Drehzahl, vom langsamsten Umlauf abgezogen: bis {} um</translation>
    </message>
    <message>
        <source>No answer from {}</source>
        <translation>Keine Antwort von {}</translation>
    </message>
    <message>
        <source>Nothing has been measured or predicted for stop.{} in many revolutions.</source>
        <translation>Für stop.{} wurde seit vielen Umdrehungen nichts gemessen oder vorhergesagt.</translation>
    </message>
    <message>
        <source>One wear coefficient, {}, explains all readings so far: neither running-in nor a change is told from it at odds of 20 to 1</source>
        <translation>Ein Verschleißkoeffizient, {}, erklärt alle bisherigen Messungen: Weder Einlauf noch eine Änderung ist mit 20 zu 1 davon zu unterscheiden</translation>
    </message>
    <message>
        <source>Position = {:.4f} um/V (voltage {:+.5f} V)</source>
        <translation>Position = {} um/V (Spannung {} V)</translation>
    </message>
    <message>
        <source>Probe 1 stands {:+.2f} degrees from the follower&apos;s axis, probe 2 {:+.2f} degrees from across it (u = {:.2f} and {:.2f} degrees)</source>
        <translation>Wegsensor 1 steht {} Grad von der Achse der Koppel, Wegsensor 2 {} Grad von der Querrichtung (u = {} und {} Grad)</translation>
    </message>
    <message>
        <source>Probe 1 {:+.4f} V, probe 2 {:+.4f} V. By the calibration in use probe {:g} stands at {:+.1f} µm</source>
        <translation>Wegsensor 1 {} V, Wegsensor 2 {} V. Nach der verwendeten Kalibrierung steht Wegsensor {} bei {} µm</translation>
    </message>
    <message>
        <source>Probe {}: run-out {:.2f} um from lowest to highest, expanded uncertainty {:.2f} um (k = {:.2f})</source>
        <translation>Wegsensor {}: Rundlauf {} um vom tiefsten zum höchsten Punkt, erweiterte Unsicherheit {} um (k = {})</translation>
    </message>
    <message>
        <source>Probe {}: {}</source>
        <translation>Wegsensor {}: {}</translation>
    </message>
    <message>
        <source>Put the micrometer&apos;s target before probe {}, at right angles to it, and turn the micrometer until probe {} shows about 0 V: that is position 0. Nothing may move before the other probe</source>
        <translation>Das Ziel der Messschraube rechtwinklig vor Wegsensor {} stellen und die Messschraube drehen, bis Wegsensor {} etwa 0 V zeigt: Das ist Position 0. Vor dem anderen Wegsensor darf sich nichts bewegen</translation>
    </message>
    <message>
        <source>Residual standard deviation: {:.3f} N</source>
        <translation>Standardabweichung der Abweichungen: {} N</translation>
    </message>
    <message>
        <source>Running-in: the wear coefficient {} from {} to {}, by two thirds within {:.0f} revolutions</source>
        <translation>Einlauf: Der Verschleißkoeffizient {} von {} auf {}, zu zwei Dritteln innerhalb von {} Umdrehungen</translation>
    </message>
    <message>
        <source>Samples of {device} have waited {age_s:.1f} s to be looked at; the limit is {limit_s:g} s.</source>
        <translation>Messwerte von {device} warteten {age_s:.1f} s auf ihre Prüfung; die Grenze ist {limit_s:g} s.</translation>
    </message>
    <message>
        <source>Signal 1 (N per {})</source>
        <translation>Signal 1 (N je {})</translation>
    </message>
    <message>
        <source>Signal 2 (N per {})</source>
        <translation>Signal 2 (N je {})</translation>
    </message>
    <message>
        <source>Signals {:+.5f}, {:+.5f} {}: the cell feels {:.1f} N</source>
        <translation>Signale {}, {} {}: Der Kraftsensor spürt {} N</translation>
    </message>
    <message>
        <source>Since about revolution {since:.0f} the joint wears {how} than the revolutions before let expect. Of 100 tests of 21,377 revolutions without a change fewer than 1 is told this.</source>
        <translation>Etwa seit Umdrehung {since:.0f} verschleißt das Gelenk {how}, als die Umdrehungen davor erwarten lassen. Von 100 Versuchen mit 21 377 Umdrehungen ohne Änderung meldet dies weniger als einer.</translation>
    </message>
    <message>
        <source>Slow roll at {:g} rpm for the run-out map</source>
        <translation>Langsamer Umlauf bei {} rpm für die Rundlaufkarte</translation>
    </message>
    <message>
        <source>Stop criterion not judged: {name}</source>
        <translation>Abbruchkriterium nicht beurteilt: {name}</translation>
    </message>
    <message>
        <source>Stop criterion: {name}</source>
        <translation>Abbruchkriterium: {name}</translation>
    </message>
    <message>
        <source>Take all weights off and turn the pin to {:.0f} degrees</source>
        <translation>Alle Gewichte abnehmen und den Bolzen auf {} Grad drehen</translation>
    </message>
    <message>
        <source>The angle between them is {:.2f} degrees (u = {:.2f})</source>
        <translation>Der Winkel zwischen ihnen ist {} Grad (u = {})</translation>
    </message>
    <message>
        <source>The cell is off by {:.2f} N, {:.2f} N are allowed: axis {} tells {:+.2f} % of the force along axis {}{}. Check the weight that hung; if it was right, calibrate the load cell again</source>
        <translation>Der Kraftsensor weicht um {} N ab, {} N sind erlaubt: Achse {} zeigt {} % der Kraft längs Achse {}{}. Das angehängte Gewicht prüfen; war es richtig, den Kraftsensor neu kalibrieren</translation>
    </message>
    <message>
        <source>The cell tells the weight within {:.2f} N ({:.2f} N are allowed)</source>
        <translation>Der Kraftsensor zeigt das Gewicht auf {} N genau ({} N sind erlaubt)</translation>
    </message>
    <message>
        <source>The crank encoder shows {encoder_rpm:.1f} rpm, the drive {drive_rpm:.1f} rpm: spindle.gear_ratio, the drive&apos;s counts per revolution or encoder.counts_per_revolution is not what the rig has, or a belt or coupling slips.</source>
        <translation>Der Drehgeber der Kurbel zeigt {encoder_rpm:.1f} rpm, der Antrieb {drive_rpm:.1f} rpm: spindle.gear_ratio, die Schritte des Antriebs je Umdrehung oder encoder.counts_per_revolution stimmen nicht mit dem Prüfstand überein, oder ein Riemen oder eine Kupplung rutscht.</translation>
    </message>
    <message>
        <source>The crank has turned for {:.4g} h; {:g} h were planned</source>
        <translation>Die Kurbel hat sich {} h gedreht; {} h waren geplant</translation>
    </message>
    <message>
        <source>The crank turns at {speed_rpm:.1f} rpm instead of {target_rpm:g} rpm after the time granted for the start.</source>
        <translation>Die Kurbel dreht nach der Zeit für den Anlauf mit {speed_rpm:.1f} rpm statt {target_rpm:g} rpm.</translation>
    </message>
    <message>
        <source>The crank turns at {speed_rpm:.1f} rpm while the test is paused.</source>
        <translation>Die Kurbel dreht mit {speed_rpm:.1f} rpm, obwohl der Versuch in Pause ist.</translation>
    </message>
    <message>
        <source>The crank turns at {speed_rpm:.1f} rpm; {target_rpm:g} rpm are set.</source>
        <translation>Die Kurbel dreht mit {speed_rpm:.1f} rpm; eingestellt sind {target_rpm:g} rpm.</translation>
    </message>
    <message>
        <source>The device&apos;s samples lag {seconds:.2f} s more behind this computer&apos;s clock than before.</source>
        <translation>Die Messwerte des Geräts hängen {seconds:.2f} s mehr hinter der Uhr dieses Rechners als zuvor.</translation>
    </message>
    <message>
        <source>The disk takes {seconds:.1f} s or longer to make the data safe.</source>
        <translation>Die Festplatte braucht {seconds:.1f} s oder länger, um die Daten zu sichern.</translation>
    </message>
    <message>
        <source>The drive reports {speed_rpm:.1f} rpm, but the crank encoder does not move.</source>
        <translation>Der Antrieb meldet {speed_rpm:.1f} rpm, aber der Drehgeber der Kurbel bewegt sich nicht.</translation>
    </message>
    <message>
        <source>The encoder counted {revolutions:.1f} revolutions without its index pulse.</source>
        <translation>Der Drehgeber zählte {revolutions:.1f} Umdrehungen ohne Indexpuls.</translation>
    </message>
    <message>
        <source>The engine is not reachable ({})</source>
        <translation>Die Steuerung ist nicht erreichbar ({})</translation>
    </message>
    <message>
        <source>The engine was shut down, but {}</source>
        <translation>Die Steuerung wurde beendet, aber {}</translation>
    </message>
    <message>
        <source>The engine&apos;s thread {} failed: {sentence}.</source>
        <translation>Der Teil {} der Steuerung ist ausgefallen: {sentence}.</translation>
    </message>
    <message>
        <source>The joint force reached {force_N:.1f} N; the limit is {limit_N:g} N.</source>
        <translation>Die Gelenkkraft erreichte {force_N:.1f} N; die Grenze ist {limit_N:g} N.</translation>
    </message>
    <message>
        <source>The joint wears {} than before: it was told at revolution {:.0f}, and began about revolution {:.0f}</source>
        <translation>Das Gelenk verschleißt {} als zuvor: gemeldet bei Umdrehung {}, begonnen etwa bei Umdrehung {}</translation>
    </message>
    <message>
        <source>The queue behind {device} was full; {blocks} blocks were dropped.</source>
        <translation>Die Warteschlange hinter {device} war voll; {blocks} Blöcke wurden verworfen.</translation>
    </message>
    <message>
        <source>The result {}. The largest part is {} (u = {:.3g} N): correct its setting, or measure it better</source>
        <translation>Das Ergebnis {}. Den größten Anteil hat {} (u = {} N): die Einstellung berichtigen oder besser messen</translation>
    </message>
    <message>
        <source>The test did not start: {}</source>
        <translation>Der Versuch begann nicht: {}</translation>
    </message>
    <message>
        <source>The test ends in step {}; raise run.revolutions</source>
        <translation>Der Versuch endet in Schritt {}; erhöhen Sie run.revolutions</translation>
    </message>
    <message>
        <source>The test has lasted {:.4g} h; it was planned for {:g} h</source>
        <translation>Der Versuch hat {} h gedauert; geplant waren {} h</translation>
    </message>
    <message>
        <source>The wear coefficient cannot be told yet, because its limits are a factor of {:.2g} apart: the depth so far, {:.2g} um, is too small against its uncertainty</source>
        <translation>Der Verschleißkoeffizient lässt sich noch nicht angeben, weil seine Grenzen um den Faktor {} auseinanderliegen: Die bisherige Tiefe, {} um, ist zu klein gegen ihre Unsicherheit</translation>
    </message>
    <message>
        <source>The wear coefficient is not constant. Whether the joint runs in or changed at one time cannot be told, because the odds are {:.2g} to 1 only; {} now</source>
        <translation>Der Verschleißkoeffizient ist nicht konstant. Ob das Gelenk einläuft oder sich zu einer Zeit geändert hat, lässt sich nicht sagen, denn es steht nur {} zu 1; jetzt {}</translation>
    </message>
    <message>
        <source>The wear rate over {} revolutions was {:.4g} um per 1000 revolutions; the limit is {:g}</source>
        <translation>Die Verschleißrate über {} Umdrehungen war {} um je 1000 Umdrehungen; die Grenze ist {}</translation>
    </message>
    <message>
        <source>The zero of axis {} stands {:+.2f} N off that of the calibration, {:.2f} N are allowed: was the cell overloaded, or is a cable off? Zero it; if it moves again, have it looked after</source>
        <translation>Der Nullpunkt von Achse {} liegt {} N neben dem der Kalibrierung, {} N sind erlaubt: War der Kraftsensor überlastet, oder ist ein Kabel ab? Nullen; wandert er wieder, ihn prüfen lassen</translation>
    </message>
    <message>
        <source>The {by} shows {speed_rpm:.1f} rpm; the limit is {limit_rpm:g} rpm.</source>
        <translation>{by} zeigt {speed_rpm:.1f} rpm; die Grenze ist {limit_rpm:g} rpm.</translation>
    </message>
    <message>
        <source>Write metadata.{}, so that the file tells</source>
        <translation>metadata.{} schreiben, damit die Datei es sagt</translation>
    </message>
    <message>
        <source>Zero ({})</source>
        <translation>Nullpunkt ({})</translation>
    </message>
    <message>
        <source>Zero: {} {}.  Model: {}</source>
        <translation>Nullpunkt: {} {}.  Modell: {}</translation>
    </message>
    <message>
        <source>a number of {} digits</source>
        <translation>eine Zahl mit {} Stellen</translation>
    </message>
    <message>
        <source>a piece of {:g} kg hangs but is not in the set</source>
        <translation>ein Stück von {} kg hängt, gehört aber nicht zum Satz</translation>
    </message>
    <message>
        <source>action_critical = &apos;none&apos; would do nothing at {} = {:g}; choose warn, pause, stop or drive_off, or give a warning level in its place</source>
        <translation>action_critical = &apos;none&apos; täte nichts bei {} = {}; warn, pause, stop oder drive_off wählen oder statt dessen eine Warngrenze angeben</translation>
    </message>
    <message>
        <source>allowed is {}</source>
        <translation>erlaubt ist {}</translation>
    </message>
    <message>
        <source>at the beginning of a rest of {:g} s</source>
        <translation>am Anfang einer Ruhe von {} s</translation>
    </message>
    <message>
        <source>at the end of a rest of {:g} s, in which it crept by {:+.6f}, {:+.6f} mV/V</source>
        <translation>am Ende einer Ruhe von {} s, in der er um {}, {} mV/V kroch</translation>
    </message>
    <message>
        <source>cannot be judged: {}</source>
        <translation>nicht zu beurteilen: {}</translation>
    </message>
    <message>
        <source>critical_{} = {:g} must lie beyond warning_{} = {:g}</source>
        <translation>critical_{} = {} muss jenseits von warning_{} = {} liegen</translation>
    </message>
    <message>
        <source>devices.{}.port is &apos;simulated&apos; but there is no [simulation]; name the port or add the section</source>
        <translation>devices.{}.port ist &apos;simulated&apos;, aber es gibt kein [simulation]; den Anschluss nennen oder den Abschnitt hinzufügen</translation>
    </message>
    <message>
        <source>devices.{}.port is empty; name the port</source>
        <translation>devices.{}.port ist leer; den Anschluss nennen</translation>
    </message>
    <message>
        <source>did you mean {}? Then write {:.6g}</source>
        <translation>war {} gemeint? Dann {} schreiben</translation>
    </message>
    <message>
        <source>does not follow from its readings ({})</source>
        <translation>folgt nicht aus seinen Messungen ({})</translation>
    </message>
    <message>
        <source>drive off above {:g} N, full scale of the cell {:g} N</source>
        <translation>Antrieb aus über {} N, Nennkraft des Kraftsensors {} N</translation>
    </message>
    <message>
        <source>encoder, load_cell and probes must come from one device, so that their samples are taken together; they name {}</source>
        <translation>encoder, load_cell und probes müssen von einem Gerät kommen, damit ihre Messwerte zusammen genommen werden; genannt sind {}</translation>
    </message>
    <message>
        <source>expired on {}</source>
        <translation>abgelaufen am {}</translation>
    </message>
    <message>
        <source>hang {}</source>
        <translation>{} anhängen</translation>
    </message>
    <message>
        <source>limits.overspeed_rpm = {:g} is not above {} = {:g}; the test would trip at once</source>
        <translation>limits.overspeed_rpm = {} liegt nicht über {} = {}; der Versuch würde sofort auslösen</translation>
    </message>
    <message>
        <source>limits.rule ({}): steps names step {}, but run.step stands {} times</source>
        <translation>limits.rule ({}): steps nennt Schritt {}, aber run.step steht {}-mal da</translation>
    </message>
    <message>
        <source>the load cell shows {} mV/V at rest {}</source>
        <translation>der Kraftsensor zeigt in Ruhe {} mV/V {}</translation>
    </message>
    <message>
        <source>{} checks</source>
        <translation>{} Prüfungen</translation>
    </message>
    <message>
        <source>{} revolutions at {:g} rpm, {:.3g} h</source>
        <translation>{} Umdrehungen mit {} rpm, {} h</translation>
    </message>
    <message>
        <source>{} revolutions at {:g} to {:g} rpm, {:.3g} h</source>
        <translation>{} Umdrehungen mit {} bis {} rpm, {} h</translation>
    </message>
    <message>
        <source>Check cable and power of {}, or go on without its channels</source>
        <translation>Kabel und Versorgung von {} prüfen oder ohne seine Kanäle fortfahren</translation>
    </message>
    <message>
        <source>Check cable and power of {}, reconnect</source>
        <translation>Kabel und Versorgung von {} prüfen, neu verbinden</translation>
    </message>
    <message>
        <source>Limits of the history for the sensitivity: {:.5f} to {:.5f}</source>
        <translation>Grenzen des Verlaufs für die Empfindlichkeit: {:.5f} bis {:.5f}</translation>
    </message>
    <message>
        <source>The last check failed: {}</source>
        <translation>Die letzte Prüfung ist nicht bestanden: {}</translation>
    </message>
    <message>
        <source>Turn the micrometer {} back past the position, to {}, then forward to {}</source>
        <translation>Messschraube {} über die Position hinaus bis {} zurückdrehen, dann vor bis {}</translation>
    </message>
    <message>
        <source>Turn the micrometer {} back to {}, then forward to {}</source>
        <translation>Messschraube {} bis {} zurückdrehen, dann vor bis {}</translation>
    </message>
    <message>
        <source>Turn the micrometer {} forward to {}. Do not turn past it</source>
        <translation>Messschraube {} vor bis {} drehen. Nicht darüber hinaus drehen</translation>
    </message>
    <message>
        <source>is of a load cell of {:g} N, the rig file says {:g} N</source>
        <translation>gehört zu einem Kraftsensor von {} N, die Prüfstandsdatei nennt {} N</translation>
    </message>
    <message>
        <source>it cannot be recorded now: {}</source>
        <translation>jetzt lässt sich nicht aufnehmen: {}</translation>
    </message>
    <message>
        <source>kind = {}: choose one of {}</source>
        <translation>kind = {}: eines von {} wählen</translation>
    </message>
    <message>
        <source>limit {} changed{}</source>
        <translation>Grenze {} geändert{}</translation>
    </message>
    <message>
        <source>line {} of the journal is not usable: {}</source>
        <translation>Zeile {} des Journals ist nicht brauchbar: {}</translation>
    </message>
    <message>
        <source>load cell zeroed{}</source>
        <translation>Kraftsensor genullt{}</translation>
    </message>
    <message>
        <source>load_cell.resolution_N = {:g} is not below load_cell.full_scale_N = {:g}</source>
        <translation>load_cell.resolution_N = {} liegt nicht unter load_cell.full_scale_N = {}</translation>
    </message>
    <message>
        <source>load_cell.zero_mV_per_V {} = {:g} is not within load_cell.range_mV_per_V = {:g}</source>
        <translation>load_cell.zero_mV_per_V {} = {} liegt nicht innerhalb von load_cell.range_mV_per_V = {}</translation>
    </message>
    <message>
        <source>no level is given; give one of {}</source>
        <translation>es ist keine Grenze angegeben; eine von {} angeben</translation>
    </message>
    <message>
        <source>no record for {}: the numbers of the rig file count</source>
        <translation>kein Kalibrierdatensatz für {}: es gelten die Zahlen der Prüfstandsdatei</translation>
    </message>
    <message>
        <source>no value for {:.0f} s</source>
        <translation>seit {} s kein Wert</translation>
    </message>
    <message>
        <source>no value lies above {:g} and below {:g}</source>
        <translation>kein Wert liegt über {} und unter {}</translation>
    </message>
    <message>
        <source>no word from the engine for {:.0f} s</source>
        <translation>seit {} s keine Meldung der Steuerung</translation>
    </message>
    <message>
        <source>now comes {}, not {}: {}</source>
        <translation>jetzt kommt {}, nicht {}: {}</translation>
    </message>
    <message>
        <source>only the load_cell can be zeroed, not {}</source>
        <translation>nur load_cell kann genullt werden, nicht {}</translation>
    </message>
    <message>
        <source>overspeed_rpm = {:g} must be above the set speed {:g} rpm</source>
        <translation>overspeed_rpm = {} muss über der eingestellten Drehzahl {} rpm liegen</translation>
    </message>
    <message>
        <source>pausing for {}</source>
        <translation>hält an für {}</translation>
    </message>
    <message>
        <source>probe {:g} is set up, not {:g}</source>
        <translation>Wegsensor {} ist eingerichtet, nicht {}</translation>
    </message>
    <message>
        <source>probe {} shows {:+.2f} V</source>
        <translation>Wegsensor {} zeigt {} V</translation>
    </message>
    <message>
        <source>probes.run_out_cos_um {} has {} orders and probes.run_out_sin_um {} has {}; give as many</source>
        <translation>probes.run_out_cos_um {} hat {} Ordnungen und probes.run_out_sin_um {} hat {}; gleich viele angeben</translation>
    </message>
    <message>
        <source>read after {:.0f} s</source>
        <translation>nach {} s gelesen</translation>
    </message>
    <message>
        <source>readings are missing: {}</source>
        <translation>Messungen fehlen: {}</translation>
    </message>
    <message>
        <source>record {} {}, used all the same: {}</source>
        <translation>Kalibrierdatensatz {} {}, trotzdem verwendet: {}</translation>
    </message>
    <message>
        <source>record {}, due {}</source>
        <translation>Kalibrierdatensatz {}, fällig {}</translation>
    </message>
    <message>
        <source>reset by {}</source>
        <translation>zurückgesetzt von {}</translation>
    </message>
    <message>
        <source>revolution {} is made already; the test can end after a later one than {}</source>
        <translation>Umdrehung {} ist schon gemacht; der Versuch kann nur nach einer späteren als {} enden</translation>
    </message>
    <message>
        <source>run-out: {}</source>
        <translation>Rundlauf: {}</translation>
    </message>
    <message>
        <source>run.repeat_from_step = {}, but run.step stands {} times</source>
        <translation>run.repeat_from_step = {}, aber run.step steht {}-mal da</translation>
    </message>
    <message>
        <source>run.step stands {} times; {} are possible, and they can be repeated</source>
        <translation>run.step steht {}-mal da; {} sind möglich, und sie lassen sich wiederholen</translation>
    </message>
    <message>
        <source>run.step {}: give revolutions or duration_s, one of the two</source>
        <translation>run.step {}: geben Sie revolutions oder duration_s an, eines von beiden</translation>
    </message>
    <message>
        <source>series repeated: {}</source>
        <translation>Reihe wiederholt: {}</translation>
    </message>
    <message>
        <source>series {} has no reading without weights</source>
        <translation>Reihe {} hat keine Messung ohne Gewichte</translation>
    </message>
    <message>
        <source>series {} is under way; finish it first, then reject and repeat series {}</source>
        <translation>Reihe {} ist im Gang; sie erst beenden, dann Reihe {} verwerfen und wiederholen</translation>
    </message>
    <message>
        <source>series {}, {:g} um</source>
        <translation>Reihe {}, {} um</translation>
    </message>
    <message>
        <source>settings: {}</source>
        <translation>Einstellungen: {}</translation>
    </message>
    <message>
        <source>signal {}</source>
        <translation>Signal {}</translation>
    </message>
    <message>
        <source>started by {}</source>
        <translation>gestartet von {}</translation>
    </message>
    <message>
        <source>steady; {} s of the waiting time are left</source>
        <translation>ruhig; noch {} s der Wartezeit</translation>
    </message>
    <message>
        <source>step {} of {}, {} left</source>
        <translation>Schritt {} von {}, noch {}</translation>
    </message>
    <message>
        <source>stop.force_N = {:g} can never be met, because limits.overload_N = {:g} switches the drive off before; lower stop.force_N</source>
        <translation>stop.force_N = {} kann nie erreicht werden, weil limits.overload_N = {} den Antrieb vorher abschaltet; stop.force_N senken</translation>
    </message>
    <message>
        <source>stop.{} {}, but prediction.enabled is false; enable the prediction or leave the criterion out</source>
        <translation>stop.{} {}, aber prediction.enabled ist false; die Vorhersage einschalten oder das Kriterium weglassen</translation>
    </message>
    <message>
        <source>take 1 to {} runs up and down</source>
        <translation>1 bis {} Durchgänge auf und ab nehmen</translation>
    </message>
    <message>
        <source>take off {}</source>
        <translation>{} abnehmen</translation>
    </message>
    <message>
        <source>take {} to {} positions</source>
        <translation>{} bis {} Positionen nehmen</translation>
    </message>
    <message>
        <source>the calibration record {} of {} {}; calibrate again, or write calibration_override with the reason</source>
        <translation>der Kalibrierdatensatz {} von {} {}; neu kalibrieren oder calibration_override mit dem Grund schreiben</translation>
    </message>
    <message>
        <source>the depth is known in {} bins of revolutions so far, and {} are needed: wait</source>
        <translation>die Tiefe ist bisher in {} Abschnitten von Umdrehungen bekannt, {} sind nötig: warten</translation>
    </message>
    <message>
        <source>the devices are not released: {}</source>
        <translation>die Geräte sind nicht freigegeben: {}</translation>
    </message>
    <message>
        <source>the drive keeps its fault: {}</source>
        <translation>der Antrieb behält seine Störung: {}</translation>
    </message>
    <message>
        <source>the encoder shows {:.1f} degrees with the crank level; it should show about 0. Is it the right flat? Else correct encoder.index_angle_deg in the rig file</source>
        <translation>der Drehgeber zeigt {} Grad bei waagerechter Kurbel; er sollte etwa 0 zeigen. Ist es die richtige Fläche? Sonst encoder.index_angle_deg in der Prüfstandsdatei berichtigen</translation>
    </message>
    <message>
        <source>the encoder shows {:.1f} degrees; turn the pin to {:.0f} degrees</source>
        <translation>der Drehgeber zeigt {} Grad; den Bolzen auf {} Grad drehen</translation>
    </message>
    <message>
        <source>the engine did not answer within {:.0f} s</source>
        <translation>die Steuerung antwortete nicht innerhalb von {} s</translation>
    </message>
    <message>
        <source>the load cell shows {:.0f} N, limits.overload_N is {:g} N; unload the pin or take the zero</source>
        <translation>der Kraftsensor zeigt {} N, limits.overload_N ist {} N; den Bolzen entlasten oder nullen</translation>
    </message>
    <message>
        <source>the load hangs for {:.0f} s, {:g} s were wanted: take it off, the creep begins again</source>
        <translation>die Last hängt seit {} s, gefordert waren {} s: abnehmen, das Kriechen beginnt neu</translation>
    </message>
    <message>
        <source>the pin stands at {:.1f} degrees</source>
        <translation>der Bolzen steht bei {} Grad</translation>
    </message>
    <message>
        <source>the plan is not possible: {}</source>
        <translation>der Plan ist nicht möglich: {}</translation>
    </message>
    <message>
        <source>the probes have no calibration record that states {}: calibrate them, or give the test their record</source>
        <translation>die Wegsensoren haben keinen Kalibrierdatensatz, der {} angibt: sie kalibrieren oder dem Versuch ihren Datensatz geben</translation>
    </message>
    <message>
        <source>the reading is not a number{}; check cable and amplifier</source>
        <translation>die Messung ist keine Zahl{}; Kabel und Verstärker prüfen</translation>
    </message>
    <message>
        <source>the test shall end after {} revolutions{}</source>
        <translation>der Versuch soll nach {} Umdrehungen enden{}</translation>
    </message>
    <message>
        <source>the two angles differ by {:.2f} degrees; was the level on the same flat both times, and the bubble in the middle?</source>
        <translation>die beiden Winkel unterscheiden sich um {} Grad; lag die Wasserwaage beide Male auf derselben Fläche, mit der Blase in der Mitte?</translation>
    </message>
    <message>
        <source>the weights cannot make {:g} kg; the nearest is {:g} kg of {:g} kg in all</source>
        <translation>die Gewichte ergeben keine {} kg; am nächsten sind {} kg von zusammen {} kg</translation>
    </message>
    <message>
        <source>the zero is taken before a test, not while {}</source>
        <translation>genullt wird vor einem Versuch, nicht im Zustand {}</translation>
    </message>
    <message>
        <source>the {:g} kg do not hang yet</source>
        <translation>die {} kg hängen noch nicht</translation>
    </message>
    <message>
        <source>the {} ended after {} of {} revolutions: {}; {} holds what was recorded</source>
        <translation>der {} endete nach {} von {} Umdrehungen: {}; {} enthält, was aufgezeichnet wurde</translation>
    </message>
    <message>
        <source>there is no reading number {}</source>
        <translation>es gibt keine Messung Nummer {}</translation>
    </message>
    <message>
        <source>there is no such quantity; did you mean {}?</source>
        <translation>eine solche Größe gibt es nicht; war {} gemeint?</translation>
    </message>
    <message>
        <source>these readings come from the rig {}, this is {}; name another journal</source>
        <translation>diese Messungen kommen vom Prüfstand {}, dies ist {}; ein anderes Journal nennen</translation>
    </message>
    <message>
        <source>unknown event {}</source>
        <translation>unbekanntes Ereignis {}</translation>
    </message>
    <message>
        <source>was taken on the rig {}, this is {}</source>
        <translation>wurde am Prüfstand {} aufgenommen, dies ist {}</translation>
    </message>
    <message>
        <source>was taken on {}, this is {}</source>
        <translation>wurde an {} aufgenommen, dies ist {}</translation>
    </message>
    <message>
        <source>weights: {} is not a mass; write for example 5x8, 2, 2, 1, 0.5 (eight pieces of 5 kg and four others)</source>
        <translation>Gewichte: {} ist keine Masse; zum Beispiel 5x8, 2, 2, 1, 0.5 schreiben (acht Stücke von 5 kg und vier andere)</translation>
    </message>
    <message>
        <source>weights: {}: give 1 to 64 pieces of up to 50 kg</source>
        <translation>Gewichte: {}: 1 bis 64 Stücke bis 50 kg angeben</translation>
    </message>
    <message>
        <source>what should hang weighs {:.1f} N</source>
        <translation>was hängen sollte, wiegt {} N</translation>
    </message>
    <message>
        <source>{:+.5f} V (the calibration in use makes {:+.1f} um of it)</source>
        <translation>{} V (die verwendete Kalibrierung macht daraus {} um)</translation>
    </message>
    <message>
        <source>{:.0f} MB needed, {:.1f} GB free</source>
        <translation>{} MB nötig, {} GB frei</translation>
    </message>
    <message>
        <source>{:.0f} samples a revolution at {:g} Hz</source>
        <translation>{} Messwerte je Umdrehung bei {} Hz</translation>
    </message>
    <message>
        <source>{:.1f} s old</source>
        <translation>{} s alt</translation>
    </message>
    <message>
        <source>{:.2f} N off, {:.2f} N are allowed</source>
        <translation>{:.2f} N daneben, {:.2f} N sind erlaubt</translation>
    </message>
    <message>
        <source>{:.3g} {} is at the end of the range</source>
        <translation>{} {} ist am Ende des Bereichs</translation>
    </message>
    <message>
        <source>{:.5f}, {:.5f} {} (the calibration in use makes {:.1f} N of it)</source>
        <translation>{}, {} {} (die verwendete Kalibrierung macht daraus {} N)</translation>
    </message>
    <message>
        <source>{:.9g} to {:.9g} {}</source>
        <translation>{} bis {} {}</translation>
    </message>
    <message>
        <source>{:g} N can never be seen: the inputs are full before</source>
        <translation>{} N können nie gesehen werden: Die Eingänge sind vorher übersteuert</translation>
    </message>
    <message>
        <source>{:g} kg</source>
        <translation>{} kg</translation>
    </message>
    <message>
        <source>{:g} kg at {:.1f} degrees</source>
        <translation>{} kg bei {} Grad</translation>
    </message>
    <message>
        <source>{:g} rpm for {} revolutions; {} records it</source>
        <translation>{} rpm über {} Umdrehungen; {} zeichnet es auf</translation>
    </message>
    <message>
        <source>{:g} rpm of {:g} rpm that the rig allows</source>
        <translation>{} rpm von {} rpm, die der Prüfstand erlaubt</translation>
    </message>
    <message>
        <source>{:g} rpm, the rig allows {:g} rpm</source>
        <translation>{} rpm, der Prüfstand erlaubt {} rpm</translation>
    </message>
    <message>
        <source>{:g} rpm: revolution {} of {}</source>
        <translation>{} rpm: Umdrehung {} von {}</translation>
    </message>
    <message>
        <source>{:g} um</source>
        <translation>{} um</translation>
    </message>
    <message>
        <source>{device} on {port} has sent no samples for {age_s:.1f} s.</source>
        <translation>{device} an {port} hat seit {age_s:.1f} s keine Messwerte gesandt.</translation>
    </message>
    <message>
        <source>{device} on {port}: {words}.</source>
        <translation>{device} an {port}: {words}.</translation>
    </message>
    <message>
        <source>{drive} on {port}: {sentence}</source>
        <translation>{drive} an {port}: {sentence}</translation>
    </message>
    <message>
        <source>{drive} reports that the emergency stop is pressed.</source>
        <translation>{drive} meldet, dass der Not-Halt gedrückt ist.</translation>
    </message>
    <message>
        <source>{drive} reports: {faults}.</source>
        <translation>{drive} meldet: {faults}.</translation>
    </message>
    <message>
        <source>{drive} warns: {warnings}.</source>
        <translation>{drive} warnt: {warnings}.</translation>
    </message>
    <message>
        <source>{number} whole cycles had no reserved room in the file.</source>
        <translation>{number} ganze Zyklen hatten keinen reservierten Platz in der Datei.</translation>
    </message>
    <message>
        <source>{} (its test)</source>
        <translation>{} (sein Versuch)</translation>
    </message>
    <message>
        <source>{} ({wired} of {device}) is at the end of its range, {span}: its cable or plug, its range, or a signal beyond it.</source>
        <translation>{} ({wired} von {device}) ist am Ende seines Bereichs, {span}: Kabel oder Stecker, der Bereich, oder ein Signal darüber hinaus.</translation>
    </message>
    <message>
        <source>{} ({} to {}) mm^3/(N m)</source>
        <translation>{} ({} bis {}) mm^3/(N m)</translation>
    </message>
    <message>
        <source>{} = {:g}: {:g} samples/s give {:.0f} samples a revolution, {} are needed; raise the sample rate</source>
        <translation>{} = {}: {} Messwerte/s geben {} Messwerte je Umdrehung, {} sind nötig; die Abtastrate erhöhen</translation>
    </message>
    <message>
        <source>{} = {} cannot be inverted; two rows say the same, or nothing</source>
        <translation>{} = {} ist nicht umkehrbar; zwei Zeilen sagen dasselbe oder nichts</translation>
    </message>
    <message>
        <source>{} = {} is not a finite number{}</source>
        <translation>{} = {} ist keine endliche Zahl{}</translation>
    </message>
    <message>
        <source>{} = {} is not a number{}</source>
        <translation>{} = {} ist keine Zahl{}</translation>
    </message>
    <message>
        <source>{} = {} is not a whole number{}</source>
        <translation>{} = {} ist keine ganze Zahl{}</translation>
    </message>
    <message>
        <source>{} = {} is not readable; write 1</source>
        <translation>{} = {} ist nicht lesbar; 1 schreiben</translation>
    </message>
    <message>
        <source>{} = {} is outside {}{}</source>
        <translation>{} = {} liegt außerhalb von {}{}</translation>
    </message>
    <message>
        <source>{} This only exercises the cell; nothing is read</source>
        <translation>{} Dies belastet den Kraftsensor nur vor; nichts wird gelesen</translation>
    </message>
    <message>
        <source>{} Wait until it hangs still</source>
        <translation>{} Warten, bis es ruhig hängt</translation>
    </message>
    <message>
        <source>{} above limit</source>
        <translation>{} über der Grenze</translation>
    </message>
    <message>
        <source>{} before a test, with the devices connected</source>
        <translation>{} vor einem Versuch, bei verbundenen Geräten</translation>
    </message>
    <message>
        <source>{} below limit</source>
        <translation>{} unter der Grenze</translation>
    </message>
    <message>
        <source>{} both name {}; each needs an input of its own</source>
        <translation>{} nennen beide {}; jeder braucht einen eigenen Eingang</translation>
    </message>
    <message>
        <source>{} does not exist or cannot be written to</source>
        <translation>{} gibt es nicht oder ist nicht beschreibbar</translation>
    </message>
    <message>
        <source>{} holds the control character \u{:04x}; take it out</source>
        <translation>{} enthält das Steuerzeichen \u{}; es herausnehmen</translation>
    </message>
    <message>
        <source>{} holds the {} at {:g} rpm already; for a new one name another record</source>
        <translation>{} enthält den {} bei {} rpm schon; für einen neuen einen anderen Datensatz nennen</translation>
    </message>
    <message>
        <source>{} in {}</source>
        <translation>{} in {}</translation>
    </message>
    <message>
        <source>{} is {}, above the {} limit {}.</source>
        <translation>{} ist {}, über der Grenze ({}) von {}.</translation>
    </message>
    <message>
        <source>{} is {}, below the {} limit {}.</source>
        <translation>{} ist {}, unter der Grenze ({}) von {}.</translation>
    </message>
    <message>
        <source>{} lost</source>
        <translation>{} ausgefallen</translation>
    </message>
    <message>
        <source>{} of this test, beside overload, overspeed and stale data</source>
        <translation>{} dieses Versuchs, neben Überlast, Überdrehzahl und veralteten Daten</translation>
    </message>
    <message>
        <source>{} on {port} has told nothing for {age_s:.0f} s{why}.</source>
        <translation>{} an {port} hat seit {age_s:.0f} s nichts gemeldet{why}.</translation>
    </message>
    <message>
        <source>{} on {port}: {sentence}</source>
        <translation>{} an {port}: {sentence}</translation>
    </message>
    <message>
        <source>{} pieces are more than {}; name fewer</source>
        <translation>{} Stücke sind mehr als {}; weniger nennen</translation>
    </message>
    <message>
        <source>{} steps, {} revolutions</source>
        <translation>{} Schritte, {} Umdrehungen</translation>
    </message>
    <message>
        <source>{} was at or {} {:g} {} in one revolution, {:.4g} {} in the last one</source>
        <translation>{} lag bei oder {} {} {} in einer Umdrehung, zuletzt bei {} {}</translation>
    </message>
    <message>
        <source>{} was at or {} {:g} {} in {} revolutions in a row, {:.4g} {} in the last one</source>
        <translation>{} lag bei oder {} {} {} in {} Umdrehungen in Folge, zuletzt bei {} {}</translation>
    </message>
    <message>
        <source>{} with this calibration: in control</source>
        <translation>{} mit dieser Kalibrierung: unter Kontrolle</translation>
    </message>
    <message>
        <source>{} {}: give {} or more different speeds from {:g} to {:g} rpm</source>
        <translation>{} {}: {} oder mehr verschiedene Drehzahlen von {} bis {} rpm angeben</translation>
    </message>
    <message>
        <source>{} {}: write speeds in rpm, such as 3,6</source>
        <translation>{} {}: Drehzahlen in rpm schreiben, zum Beispiel 3,6</translation>
    </message>
    <message>
        <source>{} × {:g} kg</source>
        <translation>{} × {:g} kg</translation>
    </message>
    <message>
        <source>{}, law {}: {}</source>
        <translation>{}, Gesetz {}: {}</translation>
    </message>
    <message>
        <source>{}, then again from step {}</source>
        <translation>{}, dann wieder ab Schritt {}</translation>
    </message>
    <message>
        <source>{}, {:.0f} s after loading</source>
        <translation>{}, {} s nach dem Belasten</translation>
    </message>
    <message>
        <source>{}, {} are planned</source>
        <translation>{}, {} sind geplant</translation>
    </message>
    <message>
        <source>{}.device = {} is not among the devices ({})</source>
        <translation>{}.device = {} ist nicht unter den Geräten ({})</translation>
    </message>
    <message>
        <source>{}.initial_wear_coefficient_mm3_per_Nm = {:g} is below bushing.wear_coefficient_mm3_per_Nm = {:g}, to which it falls</source>
        <translation>{}.initial_wear_coefficient_mm3_per_Nm = {} liegt unter bushing.wear_coefficient_mm3_per_Nm = {}, auf das er fällt</translation>
    </message>
    <message>
        <source>{}.law = {} needs bushing.wear_coefficient_mm3_per_Nm above 0</source>
        <translation>{}.law = {} braucht bushing.wear_coefficient_mm3_per_Nm über 0</translation>
    </message>
    <message>
        <source>{}.{} is missing; the law {} needs it</source>
        <translation>{}.{} fehlt; das Gesetz {} braucht es</translation>
    </message>
    <message>
        <source>{}.{} means nothing with law = {}; take it out or choose the law that reads it</source>
        <translation>{}.{} bedeutet nichts bei law = {}; herausnehmen oder das Gesetz wählen, das es liest</translation>
    </message>
    <message>
        <source>{}: another program records this run; let it end first</source>
        <translation>{}: ein anderes Programm zeichnet diesen Lauf auf; ihn erst enden lassen</translation>
    </message>
    <message>
        <source>{}: channels.{}.unit = {}, and the record {} is in {}; write its unit, or name another record</source>
        <translation>{}: channels.{}.unit = {}, und der Datensatz {} ist in {}; seine Einheit schreiben oder einen anderen Datensatz nennen</translation>
    </message>
    <message>
        <source>{}: exists and is not overwritten; name another record</source>
        <translation>{}: gibt es schon und wird nicht überschrieben; einen anderen Datensatz nennen</translation>
    </message>
    <message>
        <source>{}: holds revolution {} of {} planned; nothing is left to do</source>
        <translation>{}: enthält Umdrehung {} von {} geplanten; es bleibt nichts zu tun</translation>
    </message>
    <message>
        <source>{}: how its unit becomes SI is not known</source>
        <translation>{}: wie seine Einheit zu SI wird, ist nicht bekannt</translation>
    </message>
    <message>
        <source>{}: is not the table of a study ({})</source>
        <translation>{}: ist nicht die Tabelle einer Studie ({})</translation>
    </message>
    <message>
        <source>{}: it tells no rolls ({})</source>
        <translation>{}: enthält keine Umläufe ({})</translation>
    </message>
    <message>
        <source>{}: limits.overspeed_rpm = {:g} must be above {} = {:g}</source>
        <translation>{}: limits.overspeed_rpm = {} muss über {} = {} liegen</translation>
    </message>
    <message>
        <source>{}: line {} was changed or a line before it is missing; the store is append-only. Begin another one, and keep this</source>
        <translation>{}: Zeile {} wurde geändert, oder eine Zeile davor fehlt; an die Datei wird nur angehängt. Eine neue beginnen und diese aufheben</translation>
    </message>
    <message>
        <source>{}: nothing is left to do. {}</source>
        <translation>{}: es bleibt nichts zu tun. {}</translation>
    </message>
    <message>
        <source>{}: the elastic motion of the pin cannot be taken off: {}; roll again with --test and the test file of this bushing</source>
        <translation>{}: die elastische Bewegung des Bolzens lässt sich nicht abziehen: {}; noch einmal umlaufen, mit --test und der Versuchsdatei dieser Buchse</translation>
    </message>
    <message>
        <source>{}: the map in use has expired, and an expired record forbids a start: take run_out out of [probes] for the roll</source>
        <translation>{}: die verwendete Karte ist abgelaufen, und ein abgelaufener Datensatz verbietet den Start: run_out für den Umlauf aus [probes] herausnehmen</translation>
    </message>
    <message>
        <source>{}: the record cannot be read ({})</source>
        <translation>{}: der Datensatz ist nicht lesbar ({})</translation>
    </message>
    <message>
        <source>{}: the record {} has no {}</source>
        <translation>{}: der Datensatz {} hat kein {}</translation>
    </message>
    <message>
        <source>{}: the record {} is in N per {}; the rig measures mV/V</source>
        <translation>{}: der Datensatz {} ist in N je {}; der Prüfstand misst mV/V</translation>
    </message>
    <message>
        <source>{}: there are no daily checks yet; take one first</source>
        <translation>{}: Es gibt noch keine täglichen Prüfungen; zuerst eine vornehmen</translation>
    </message>
    <message>
        <source>{}: there is no daily check of the rig {}</source>
        <translation>{}: Es gibt keine tägliche Prüfung des Prüfstands {}</translation>
    </message>
    <message>
        <source>{}: this is the record of a {}, not of a {}</source>
        <translation>{}: dies ist der Datensatz zu {}, nicht zu {}</translation>
    </message>
    <message>
        <source>{}: {} = {:g} is above the rig&apos;s spindle.maximum_speed_rpm = {:g}</source>
        <translation>{}: {} = {} liegt über spindle.maximum_speed_rpm = {} des Prüfstands</translation>
    </message>
    <message>
        <source>{}; check the device</source>
        <translation>{}; das Gerät prüfen</translation>
    </message>
    <message>
        <source>{}; move it or the target until it shows about 0 V</source>
        <translation>{}; ihn oder das Ziel verschieben, bis er etwa 0 V zeigt</translation>
    </message>
    <message>
        <source>{}limits.overload_N = {:g} can never be seen: the input of the load cell is full at {:.0f} N; lower the limit or raise load_cell.range_mV_per_V</source>
        <translation>{}limits.overload_N = {} kann nie gesehen werden: Der Eingang des Kraftsensors ist bei {} N übersteuert; die Grenze senken oder load_cell.range_mV_per_V vergrößern</translation>
    </message>
    <message>
        <source>{}limits.rule {} ({}): {}</source>
        <translation>{}limits.rule {} ({}): {}</translation>
    </message>
    <message>
        <source>{}{}: {:g} kg hang then</source>
        <translation>{}{}: Dann hängen {} kg</translation>
    </message>
</context>
</TS>
